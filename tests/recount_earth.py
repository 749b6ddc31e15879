# SPDX-License-Identifier: Apache-2.0
"""Ways on the WGS 84 ellipsoid for the recount (Vincenty 1975): shares nothing with the program."""
import math

A, F = 6378137.0, 1 / 298.257223563
B = A * (1 - F)


def series(cos2_alpha):
    u2 = cos2_alpha * (A * A - B * B) / (B * B)
    return (1 + u2 / 16384 * (4096 + u2 * (-768 + u2 * (320 - 175 * u2))),
            u2 / 1024 * (256 + u2 * (-128 + u2 * (74 - 47 * u2))))


def delta_sigma(b, sin_s, cos_s, c2m):
    return b * sin_s * (c2m + b / 4 * (cos_s * (2 * c2m**2 - 1)
                                       - b / 6 * c2m * (4 * sin_s**2 - 3) * (4 * c2m**2 - 3)))


def travel(lat, lon, distance, bearing):
    """Where one arrives; degrees, metres, radians clockwise from north."""
    if distance == 0:
        return lat, lon
    tan_u = (1 - F) * math.tan(math.radians(lat))
    cos_u = 1 / math.hypot(1, tan_u)
    sin_u = tan_u * cos_u
    sin_a, cos_a = math.sin(bearing), math.cos(bearing)
    sigma1 = math.atan2(tan_u, cos_a)
    sin_alpha = cos_u * sin_a
    cos2 = 1 - sin_alpha**2
    a, b = series(cos2)
    sigma = distance / (B * a)
    for _ in range(50):
        c2m = math.cos(2 * sigma1 + sigma)
        following = distance / (B * a) + delta_sigma(b, math.sin(sigma), math.cos(sigma), c2m)
        if abs(following - sigma) < 1e-15:
            break
        sigma = following
    s, c = math.sin(sigma), math.cos(sigma)
    lat2 = math.atan2(sin_u * c + cos_u * s * cos_a, (1 - F) * math.hypot(sin_alpha, sin_u * s - cos_u * c * cos_a))
    lam = math.atan2(s * sin_a, cos_u * c - sin_u * s * cos_a)
    k = F / 16 * cos2 * (4 + F * (4 - 3 * cos2))
    c2m = math.cos(2 * sigma1 + sigma)
    lam -= (1 - k) * F * sin_alpha * (sigma + k * s * (c2m + k * c * (2 * c2m**2 - 1)))
    return math.degrees(lat2), (lon + math.degrees(lam) + 180) % 360 - 180


def plane(lat1, lon1, lat2, lon2):
    """East and north of place 2 in the plane about place 1, metres (azimuthal equidistant)."""
    if lat1 == lat2 and lon1 == lon2:
        return 0.0, 0.0
    u1, u2 = (math.atan((1 - F) * math.tan(math.radians(v))) for v in (lat1, lat2))
    length = math.radians((lon2 - lon1 + 180) % 360 - 180)
    lam = length
    for _ in range(200):
        sl, cl = math.sin(lam), math.cos(lam)
        x, y = math.cos(u2) * sl, math.cos(u1) * math.sin(u2) - math.sin(u1) * math.cos(u2) * cl
        s, c = math.hypot(x, y), math.sin(u1) * math.sin(u2) + math.cos(u1) * math.cos(u2) * cl
        sigma = math.atan2(s, c)
        sin_alpha = math.cos(u1) * math.cos(u2) * sl / s
        cos2 = 1 - sin_alpha**2
        c2m = c - 2 * math.sin(u1) * math.sin(u2) / cos2 if cos2 else 0.0
        k = F / 16 * cos2 * (4 + F * (4 - 3 * cos2))
        following = length + (1 - k) * F * sin_alpha * (sigma + k * s * (c2m + k * c * (2 * c2m**2 - 1)))
        if abs(following - lam) < 1e-14:
            break
        lam = following
    a, b = series(cos2)
    distance = B * a * (sigma - delta_sigma(b, s, c, c2m))
    bearing = math.atan2(x, y)
    return distance * math.sin(bearing), distance * math.cos(bearing)
