"""Tests of axes that never were: effects, noise and conditions of one's choice, to try and to measure by."""
