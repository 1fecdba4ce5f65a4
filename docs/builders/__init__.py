"""What writes generated pages and pictures of the documentation, a module each: `build(docs, progress)`."""
