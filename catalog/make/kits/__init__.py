"""Things of sculpted parts, jointed where the thing is: one module each has a `KIT`; `catalog.make.kit` makes assets of them."""
