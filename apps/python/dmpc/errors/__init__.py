"""The benchmark `error`: what every knob of a render costs, and what it does to the picture's error."""
