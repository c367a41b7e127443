"""The HTTP face of Vocalis: the page, the synchronous calls and the job API."""
