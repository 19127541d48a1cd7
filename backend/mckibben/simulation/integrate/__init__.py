"""From equations to a run: machine code for rates and Jacobian, the elimination plan, the Rodas4 kernel."""
