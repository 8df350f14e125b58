"""House acceptance rules for machine axes, as standards of zlmreport."""
