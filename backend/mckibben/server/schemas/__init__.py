"""What goes over the wire: one module per noun, separate shapes for requests and answers."""
