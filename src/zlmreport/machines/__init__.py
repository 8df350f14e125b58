"""The model of a whole machine: what its axes predict, what tests show, and which effect is missing."""
