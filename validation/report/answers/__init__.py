"""The first screen of a report: for each question, over which range MDR is enough, made from the results."""
