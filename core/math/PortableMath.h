// Transcendental functions made of additions and multiplications only, so that the library's bytes
// do not depend on the machine's maths library (whose last bit differs between CPUs and versions).
// Relative error below 1e-12 (acos: 3e-8 absolute) over the ranges used here.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace patina::library {

inline constexpr double kPi = 3.14159265358979323846;

inline double roundNearest(double x) {
    return static_cast<double>(static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5)));
}

// sin(2 pi x): reduced to a quarter turn either side of 0, Taylor series to x^19 (error 3e-16).
inline double sinTurns(double x) {
    x -= roundNearest(x);
    if (x > 0.25)
        x = 0.5 - x;
    else if (x < -0.25)
        x = -0.5 - x;
    const double a = x * (2.0 * kPi);
    const double q = a * a;
    double term = 1.0;
    for (int n = 18; n >= 2; n -= 2)
        term = 1.0 - q * (1.0 / (n * (n + 1))) * term;
    return a * term;
}
inline double cosTurns(double x) {
    return sinTurns(x + 0.25);
}
inline double sinRad(double radians) {
    return sinTurns(radians / (2.0 * kPi));
}
inline double cosRad(double radians) {
    return cosTurns(radians / (2.0 * kPi));
}

// 2^x for |x| < 1000: the integer part goes into the exponent bits, the rest is a Taylor series.
inline double exp2Portable(double x) {
    const double whole = roundNearest(x);
    const double a = (x - whole) * 0.69314718055994530942;
    double sum = 1.0;
    for (int n = 11; n >= 1; --n)
        sum = 1.0 + a * (1.0 / n) * sum;
    const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52;
    return sum * std::bit_cast<double>(bits);
}
inline double expPortable(double x) {
    return x < -700.0 ? 0.0 : exp2Portable(x * 1.44269504088896340736);
}

// log2 of a positive normal number: the mantissa in [sqrt(1/2), sqrt(2)) by the series of atanh.
inline double log2Portable(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    auto exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
    double m = std::bit_cast<double>((bits & 0xfffffffffffffull) | (1023ull << 52));
    if (m > 1.41421356237309504880) {
        m *= 0.5;
        ++exponent;
    }
    const double s = (m - 1.0) / (m + 1.0);
    const double q = s * s;
    double sum = 0.0;
    for (int n = 15; n >= 1; n -= 2)
        sum = sum * q + 1.0 / n;
    return static_cast<double>(exponent) + 2.88539008177792681472 * s * sum;
}
inline double powPortable(double x, double y) {
    return x <= 0.0 ? 0.0 : exp2Portable(y * log2Portable(x));
}

// Abramowitz & Stegun 4.4.46, error below 3e-8.
inline double acosPortable(double x) {
    const double a = x < 0 ? -x : x;
    if (a >= 1.0)
        return x < 0 ? kPi : 0.0;
    double p = -0.0012624911;
    p = p * a + 0.0066700901;
    p = p * a - 0.0170881256;
    p = p * a + 0.0308918810;
    p = p * a - 0.0501743046;
    p = p * a + 0.0889789874;
    p = p * a - 0.2145988016;
    p = p * a + 1.5707963050;
    const double angle = std::sqrt(1.0 - a) * p;
    return x < 0 ? kPi - angle : angle;
}

inline float saturate(float x) {
    return x < 0.0f ? 0.0f : (x > 1.0f ? 1.0f : x);
}
inline float mix(float a, float b, float t) {
    return a + (b - a) * t;
}
inline float smoothstep(float edge0, float edge1, float x) {
    const float t = saturate((x - edge0) / (edge1 - edge0));
    return t * t * (3.0f - 2.0f * t);
}

} // namespace patina::library
