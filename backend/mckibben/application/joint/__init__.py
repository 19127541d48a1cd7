"""What a joint does at rest: torque over angle, stiffness, pressures for an angle and a stiffness."""
