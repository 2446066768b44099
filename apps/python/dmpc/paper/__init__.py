"""The study paper: the tables and claims of the article of 1994, regenerated on its machine and compared with the printed ones."""
