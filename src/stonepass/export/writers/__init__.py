"""The declarations of the export formats, one file each; none loads a numerical library."""
