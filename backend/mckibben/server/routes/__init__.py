"""One module per resource; a route converts the request, calls the use case, converts the result."""
