"""Turns the records of one measurement into tables, figures and a page; reads JSON and its schema alone."""
