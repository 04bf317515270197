// (filled in with its first commit)
