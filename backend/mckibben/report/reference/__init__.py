"""Reference pages: Python names from their docstrings, the HTTP interface from its OpenAPI document.

Both are made from objects that the caller passes in; nothing here imports the door or the server.
"""
