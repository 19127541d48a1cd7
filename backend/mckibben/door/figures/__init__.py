"""Plotly figures of results, with the look of the studio; plotly is imported when the first is drawn."""
