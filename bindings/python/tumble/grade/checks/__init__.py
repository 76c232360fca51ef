"""The four parts of the assignment, one module each.

Each module has the same names:

NUMBER, TITLE, FUNCTION, MAXIMUM
    Number and title of the part, the student's function that it judges, and its points.
cases(params)
    List of `Case`: the states to judge in, from a fixed seed, with the right results. SI units.
items(params)
    List of `Item`: the sub-points. With the points for the form of the results they add up to MAXIMUM.
readings()
    List of `Reading`: ways to understand a result, the documented one first.
variants(params)
    List of `Variant`: deliberately wrong solutions, most likely first.
"""
