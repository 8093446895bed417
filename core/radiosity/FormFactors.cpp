#include "core/radiosity/FormFactors.h"

#include "core/radiosity/AnalyticFactors.h"
#include "core/radiosity/HemicubeFactors.h"
#include "core/radiosity/ParaboloidFactors.h"
#include "core/radiosity/RayFactors.h"

namespace patina::radiosity {

double FactorRow::sum() const {
    double total = 0.0;
    for (const Share& share : shares)
        total += share.factor;
    return total;
}

std::string_view name(FactorMethod method) {
    switch (method) {
    case FactorMethod::Rays:
        return "raycast";
    case FactorMethod::Hemicube:
        return "hemicube";
    case FactorMethod::Analytic:
        return "analytic";
    case FactorMethod::Paraboloid:
        break;
    }
    return "paraboloid";
}

ResolutionRange resolutionRange(FactorMethod method) {
    switch (method) {
    case FactorMethod::Rays:
        return {256, 1, 1 << 20};
    case FactorMethod::Hemicube:
        return {256, 2, 4096};
    case FactorMethod::Analytic:
        return {64, 1, 65536};
    case FactorMethod::Paraboloid:
        break;
    }
    return {512, 2, 4096}; // in the middle a texel is as large as a cell of a hemicube of 256
}

Result<std::unique_ptr<FormFactors>>
makeFormFactors(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings) {
    using Made = std::unique_ptr<FormFactors>;
    switch (settings.method) {
    case FactorMethod::Rays:
        return Made(std::make_unique<RayFactors>(elements, rays, settings));
    case FactorMethod::Hemicube:
        return HemicubeFactors::make(elements, rays, settings);
    case FactorMethod::Analytic:
        return Made(std::make_unique<AnalyticFactors>(elements, rays, settings));
    case FactorMethod::Paraboloid:
        break;
    }
    return Made(std::make_unique<ParaboloidFactors>(elements, rays, settings));
}

} // namespace patina::radiosity
