"""What `scripts/docs` does: hold the Markdown pages against the code, the files and the commands that they speak of."""
