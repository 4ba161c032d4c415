"""The pages of the PDF report and what they are drawn with."""
