"""The core that standards share: statistics by position, parameters, requirements, evaluations."""
