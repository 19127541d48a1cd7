"""From a checked request to the numbers of the answer: what the routes and the command line share."""
