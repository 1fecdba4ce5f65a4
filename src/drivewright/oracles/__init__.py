"""Independent routes and other engines, for `verify`: a package of the name of each kind that has one, asked for by that name alone."""
