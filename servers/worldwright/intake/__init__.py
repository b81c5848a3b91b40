"""A user's mesh file becomes an asset that plans can name: it is taken in confined, and registered whole or not at all."""
