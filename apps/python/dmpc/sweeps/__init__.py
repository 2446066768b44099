"""The study of one scene with all combinations of any options of dmpc render: `dmpc study sweep`."""
