#include "core/trace/path/TraceOutputs.h"

#include <cmath>

namespace patina {

static_assert(sizeof(TraceOutputs::Pixel) == 112);

void TraceOutputSum::add(const TraceSample& sample, const glm::vec3& radiance) {
    if (sample.hit) {
        ++m_hits;
        m_albedo += glm::dvec3(sample.albedo);
        m_normal += glm::dvec3(sample.normal);
        m_position += glm::dvec3(sample.position);
    }
    if (!std::isfinite(radiance.x) || !std::isfinite(radiance.y) || !std::isfinite(radiance.z))
        return;
    m_emission += glm::dvec3(sample.emission);
    m_background += glm::dvec3(sample.background);
    m_directDiffuse += glm::dvec3(sample.directDiffuse);
    m_directSpecular += glm::dvec3(sample.directSpecular);
    m_indirectDiffuse += glm::dvec3(sample.indirectDiffuse);
    m_indirectSpecular += glm::dvec3(sample.indirectSpecular);
}

void TraceOutputSum::addTo(TraceOutputs::Pixel& pixel) const {
    const auto add = [](glm::vec3& to, const glm::dvec3& sum) {
        to = glm::vec3(glm::dvec3(to) + sum);
    };
    add(pixel.albedo, m_albedo);
    add(pixel.normal, m_normal);
    add(pixel.position, m_position);
    add(pixel.emission, m_emission);
    add(pixel.background, m_background);
    add(pixel.directDiffuse, m_directDiffuse);
    add(pixel.directSpecular, m_directSpecular);
    add(pixel.indirectDiffuse, m_indirectDiffuse);
    add(pixel.indirectSpecular, m_indirectSpecular);
    pixel.hits += m_hits;
}

glm::vec3 TraceSplit::shareOf(const glm::vec3& diffuse, const glm::vec3& specular) {
    glm::vec3 share(0.0f);
    for (int c = 0; c < 3; ++c)
        if (const float both = diffuse[c] + specular[c]; both != 0.0f)
            share[c] = diffuse[c] / both;
    return share;
}

} // namespace patina
