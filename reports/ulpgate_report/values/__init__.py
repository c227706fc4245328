"""What a record holds: numbers, types, time steps, what it is of; pure, and below every other room."""
