"""The committed plan: what it may say, how it is read, edited and written."""
