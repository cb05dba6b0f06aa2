"""What people decide after the machine: marks of written answers, overrides, late rules, and how they are merged."""
