"""Numerics without mechanics.

`quadrature`     Gauss-Legendre on pieces.
`roots`          bracketed roots of one variable, damped Newton steps for several, extremes.
`line_search`    how far to go along a step on a convex function.
`lanes`          decisions of kernels that compute one case or many.
`trigonometry`   cosine and sine for them.
`small`          factors of small matrices in kernels.
`linear`         null spaces and pivots of small matrices.
`least_squares`  fits with the covariance of their parameters.
`samples`        a random sample: estimates with their confidence intervals.
`splines`        splines through points, as piecewise polynomials.
`smoothing`      the smoothest curve within a band about points.
`jets`           a value with its first three derivatives.
`signals`        maxima, means and spectra of sampled signals.
`ensemble`       means of correlated samples with their intervals.
`student`        Student's distribution.
`chaos`          the largest Lyapunov exponent, the period of an orbit.
`ode`            initial value problems.
"""
