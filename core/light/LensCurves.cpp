#include "core/light/LensCurves.h"

#include "core/job/Parallel.h"
#include "core/light/DfgTable.h"

#include <algorithm>
#include <glm/trigonometric.hpp>

namespace patina {

namespace {

constexpr int kAlbedoAngles = 31; // 0…90°, 3° apart
constexpr float kRightAngle = shading::kPi / 2.0f;

glm::vec3 opposite(float incidence) {
    return lensDirection(-incidence);
}

LensCurves angularCurves(const LensLook& look, const LensRequest& request, const ImagePtr& table) {
    LensCurves curves;
    curves.lens = std::make_shared<const BrdfLens>(look.model, look.point, table);
    const BrdfLens& lens = *curves.lens;
    const glm::vec3 light = opposite(request.incidence);
    for (const float angle : lensAngles(request.incidence, lens.alpha())) {
        const glm::vec3 v = lensDirection(angle);
        curves.lobe.emplace_back(
            glm::degrees(angle),
            lobeValue(lens.brdf(light, v, request.scale.lobe), v.z, request.scale));
    }
    LobeScale factor = request.scale;
    factor.cosine = false;
    for (const float angle : lensAngles(0.0f, lens.alpha()))
        if (angle >= 0.0f) {
            const float degrees = glm::degrees(angle);
            curves.distribution.emplace_back(degrees, lens.distribution(angle));
            curves.masking.emplace_back(degrees, lens.masking(-request.incidence, angle));
            curves.fresnel.emplace_back(degrees, lobeValue(lens.fresnel(angle), 1.0f, factor));
        }
    return curves;
}

} // namespace

ImagePtr DfgTables::of(const ShadingModel& model) {
    const Visibility visibility = iblVisibility(model.visibility);
    ImagePtr& table = m_tables[{model.distribution, visibility}];
    if (!table)
        table = std::make_shared<const Image>(
            computeDfgTable(static_cast<int>(shading::kDfgTableSize), model.distribution,
                            visibility, DfgTexels::ToTheEnds));
    return table;
}

LensResult evaluateLens(const LensRequest& request, DfgTables& tables, const JobContext& job) {
    LensResult result;
    result.request = request;
    for (const LensLook& look : request.looks) {
        result.curves.push_back(angularCurves(look, request, tables.of(look.model)));
        for (const glm::vec2& point : result.curves.back().lobe)
            result.peak = std::max(result.peak, point.y);
    }

    // The integrals, and the meshes, which have one scale.
    LobeScale factor = request.scale;
    factor.cosine = false;
    const std::size_t looks = request.looks.size();
    std::vector<LensAlbedo> albedos(looks * kAlbedoAngles);
    const auto angleOf = [](std::size_t i) {
        return kRightAngle * static_cast<float>(i) / static_cast<float>(kAlbedoAngles - 1);
    };
    parallelFor(job, albedos.size() + looks, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (i < albedos.size())
                albedos[i] = result.curves[i / kAlbedoAngles].lens->albedo(
                    angleOf(i % kAlbedoAngles), request.scale.lobe);
            else
                result.curves[i - albedos.size()].mesh = makeLobeMesh(
                    *result.curves[i - albedos.size()].lens, opposite(request.incidence),
                    LobeEnd::Light, request.scale, result.peak);
    });
    if (job.cancelled()) {
        result.curves.clear();
        return result;
    }
    for (std::size_t i = 0; i < albedos.size(); ++i) {
        LensCurves& curves = result.curves[i / kAlbedoAngles];
        const float degrees = glm::degrees(angleOf(i % kAlbedoAngles));
        curves.single.emplace_back(degrees, lobeValue(albedos[i].single, 1.0f, factor));
        curves.multi.emplace_back(degrees, lobeValue(albedos[i].multi, 1.0f, factor));
        curves.exact.emplace_back(degrees, lobeValue(albedos[i].exact, 1.0f, factor));
    }
    return result;
}

} // namespace patina
