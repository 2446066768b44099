"""The study `dmpc study systems`: the systems that the 1994 article classifies, side by side on one machine."""
