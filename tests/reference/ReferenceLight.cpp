#include "tests/reference/ReferenceLight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina::reference {
namespace {

constexpr double kPi = std::numbers::pi;

// sqrt((2l + 1) / 4 pi (l - m)! / (l + m)!), times sqrt 2 for the real functions of m > 0.
struct Factors {
    double of[kOrders][kOrders];
    Factors() {
        for (int l = 0; l < kOrders; ++l)
            for (int m = 0; m <= l; ++m)
                of[l][m] = std::sqrt((m > 0 ? 2.0 : 1.0) * (2 * l + 1) / (4 * kPi) *
                                     std::tgamma(l - m + 1) / std::tgamma(l + m + 1));
    }
};

} // namespace

// Green 2003, "Spherical Harmonic Lighting: The Gritty Details", with sin^m e^(i m phi) as
// (x + iy)^m.
Basis basisAt(const glm::dvec3& d) {
    static const Factors factors;
    Basis y;
    double re = 1.0, im = 0.0, pmm = 1.0; // (x + iy)^m; P_mm / sin^m = (-1)^m (2m - 1)!!
    for (int m = 0; m < kOrders; ++m) {
        double below = 0.0, p = pmm;
        for (int l = m; l < kOrders; ++l) {
            const double k = factors.of[l][m];
            y[std::size_t(l * (l + 1) + m)] = k * p * re;
            if (m > 0)
                y[std::size_t(l * (l + 1) - m)] = k * p * im;
            const double above = ((2 * l + 1) * d.z * p - (l + m) * below) / (l - m + 1);
            below = p;
            p = above;
        }
        const double turned = re * d.x - im * d.y;
        im = re * d.y + im * d.x;
        re = turned;
        pmm *= -(2 * m + 1);
    }
    return y;
}

glm::dvec3 ReferenceLight::pixel(int x, int y) const {
    const std::size_t at = std::size_t(y) * std::size_t(m_picture->width()) + std::size_t(x);
    const float* p = m_picture->f32().data() + at * std::size_t(m_picture->channels());
    return {p[0], p[1], p[2]};
}

ReferenceLight::ReferenceLight(ImagePtr environment)
    : m_picture(std::move(environment)) {
    const int width = m_picture->width(), height = m_picture->height();
    for (int j = 0; j < height; ++j) {
        const double top = kPi * j / height, bottom = kPi * (j + 1) / height;
        const double solidAngle = 2 * kPi / width * (std::cos(top) - std::cos(bottom));
        const double theta = 0.5 * (top + bottom);
        double power = 0.0;
        for (int i = 0; i < width; ++i) {
            const double phi = 2 * kPi * ((i + 0.5) / width - 0.5);
            const Basis y = basisAt({std::sin(theta) * std::sin(phi), std::cos(theta),
                                     -std::sin(theta) * std::cos(phi)});
            const glm::dvec3 light = solidAngle * pixel(i, j);
            for (std::size_t k = 0; k < y.size(); ++k)
                m_coefficients[k] += y[k] * light;
            m_columns.push_back(power += light.x + light.y + light.z);
        }
        m_rows.push_back(power + (m_rows.empty() ? 0.0 : m_rows.back()));
    }
}

void ReferenceLight::bands(const Basis& basis, std::array<glm::dvec3, kLights>& out) const {
    glm::dvec3 sum(0.0);
    for (int l = 0; l < kOrders; ++l) {
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            sum += basis[std::size_t(i)] * m_coefficients[std::size_t(i)];
        out[std::size_t(l) + 1] = sum;
    }
}

ReferenceLight::Ray ReferenceLight::sample(const glm::dvec2& sample) const {
    const int width = m_picture->width(), height = m_picture->height();
    // The pixel, and how far into it the sample reaches, 0…1.
    const auto find = [](const double* begin, const double* end, double& at) {
        const double wanted = at * end[-1];
        const double* found = std::min(std::upper_bound(begin, end, wanted), end - 1);
        const double before = found == begin ? 0.0 : found[-1];
        at = std::clamp((wanted - before) / (*found - before), 0.0, 1.0);
        return int(found - begin);
    };
    glm::dvec2 inside = sample;
    const int j = find(m_rows.data(), m_rows.data() + height, inside.y);
    const double* row = m_columns.data() + std::size_t(j) * std::size_t(width);
    const int i = find(row, row + width, inside.x);
    const double top = std::cos(kPi * j / height), bottom = std::cos(kPi * (j + 1) / height);
    const double y = top + inside.y * (bottom - top), side = std::sqrt(1.0 - y * y);
    const double phi = 2 * kPi * ((i + inside.x) / width - 0.5);
    Ray ray;
    ray.direction = {side * std::sin(phi), y, -side * std::cos(phi)};
    ray.radiance = pixel(i, j);
    ray.density = (ray.radiance.x + ray.radiance.y + ray.radiance.z) / m_rows.back();
    return ray;
}

} // namespace patina::reference
