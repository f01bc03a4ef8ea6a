"""Algorithm 1 of the framework paper on the double pendulum, in 50 digits: the bar's multiplier in five steps.

Written in its own six coordinates (joint, u, v of the RUV triangle; the bar's lower end is the joint), apart from the
Rust code. Prints step, multiplier [N/m] and the joint.
"""

from mpmath import lu_solve, matrix, mp, mpf, nstr, zeros

mp.dps = 50
m1, m2 = mpf("2.6934977798e-2"), mpf("0.1271425597")
g, h = mpf("9.81"), mpf("1e-3")
cx, cy = mpf("0.05"), mpf("0.05") / 3
jx, jy = m2 * mpf("0.01") / 24, m2 * mpf("0.0025") / 18

scalar = matrix([
    [m1 / 3 + m2, m2 * cx, m2 * cy],
    [m2 * cx, jx + m2 * cx * cx, m2 * cx * cy],
    [m2 * cy, m2 * cx * cy, jy + m2 * cy * cy],
])
M = zeros(6, 6)
for i in range(3):
    for j in range(3):
        for d in range(2):
            M[2 * i + d, 2 * j + d] = scalar[i, j]
F = zeros(6, 1)
F[1], F[3], F[5] = -(m1 / 2 + m2) * g, -m2 * cx * g, -m2 * cy * g


def phi(q):
    return matrix([
        q[0] ** 2 + q[1] ** 2 - mpf("0.005"),
        q[2] ** 2 + q[3] ** 2 - 1,
        q[4] ** 2 + q[5] ** 2 - 1,
        q[2] * q[4] + q[3] * q[5],
    ])


def jacobian(q):
    a = zeros(4, 6)
    for row in range(3):
        for d in range(2):
            a[row, 2 * row + d] = 2 * q[2 * row + d]
    a[3, 2], a[3, 3], a[3, 4], a[3, 5] = q[4], q[5], q[2], q[3]
    return a


q = matrix([mpf("0.05"), -mpf("0.05"), 1, 0, 0, 1])
p = zeros(6, 1)
for step in range(1, 6):
    upper, x, nu = jacobian(q), q.copy(), zeros(4, 1)
    while True:
        residual = list(M * (x - q) - h * p - h * h / 2 * F - upper.T * nu) + list(phi(x))
        if max(abs(r) for r in residual) < mpf(10) ** -45:
            break
        K, lower = zeros(10, 10), jacobian(x)
        for i in range(6):
            for j in range(6):
                K[i, j] = M[i, j]
            for j in range(4):
                K[i, 6 + j], K[6 + j, i] = -upper[j, i], lower[j, i]
        delta = lu_solve(K, -matrix(residual))
        for i in range(6):
            x[i] += delta[i]
        for j in range(4):
            nu[j] += delta[6 + j]
    p = M * (x - q) / h + h / 2 * F + jacobian(x).T * nu / h
    q = x
    print(step, nstr(2 / h**2 * nu[0], 18), nstr(q[0], 17), nstr(q[1], 17))
