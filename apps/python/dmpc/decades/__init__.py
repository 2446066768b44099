"""The study `dmpc study decades`: what should travel, pages, rays or questions, on machines of 1988 to 2025."""
