#include "app/editor/panel/TransferStudy.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/local/NearLightAt.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/math/Shading.h"
#include "core/mix/TransferLight.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace patina::editor {
namespace {

constexpr int kHeight = 192;   // of the pictures
constexpr int kRayHeight = 64; // 8192 rays
constexpr int kRings = 48, kSegments = 64;
constexpr glm::vec3 kPositive{0.35f, 0.75f, 0.66f}, kNegative{0.92f, 0.2f, 0.75f};

// The transfer all around as a surface: as far out as it lets light through; where the bands make
// it negative, as far out as it takes light away, in magenta.
LobeMesh lobeMesh(const PointTransfer& transfer, unsigned bands, float peak) {
    LobeMesh mesh;
    const auto at = [&](int ring, int segment) {
        const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings;
        const float phi =
            2.0f * std::numbers::pi_v<float> * static_cast<float>(segment) / kSegments;
        return glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                         std::sin(theta) * std::sin(phi));
    };
    for (int ring = 0; ring <= kRings; ++ring)
        for (int segment = 0; segment <= kSegments; ++segment) {
            const glm::vec3 direction = at(ring, segment);
            const float value = transfer.towards(direction, bands);
            mesh.positions.push_back(direction * (std::abs(value) / peak));
            mesh.colors.push_back(value < 0.0f ? kNegative : kPositive);
        }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
    const auto row = static_cast<std::uint32_t>(kSegments + 1);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 area = glm::cross(mesh.positions[b] - mesh.positions[a],
                                          mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t i : {a, b, c})
            mesh.normals[i] += area;
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
    };
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t segment = 0; segment < kSegments; ++segment) {
            const std::uint32_t i = ring * row + segment;
            add(i, i + 1, i + row);
            add(i + 1, i + row + 1, i + row);
        }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        glm::vec3& normal = mesh.normals[i];
        const float length = glm::length(normal);
        normal = length > 1e-12f ? normal / length
                                 : at(static_cast<int>(i / row), static_cast<int>(i % row));
    }
    return mesh;
}

QRgb blend(QRgb color, double light) {
    return qRgb(static_cast<int>(qRed(color) * light), static_cast<int>(qGreen(color) * light),
                static_cast<int>(qBlue(color) * light));
}

// Green as it lets light through, magenta where it would take some away.
QImage functionPicture(const PointTransfer& transfer, unsigned bands, TransferStudy& study) {
    QImage picture(2 * kHeight, kHeight, QImage::Format_RGB32);
    std::vector<float> values;
    double negative = 0.0, whole = 0.0;
    study.lowest = study.highest = 0.0f;
    for (int y = 0; y < kHeight; ++y) {
        const double solidAngle = std::sin(std::numbers::pi * (y + 0.5) / kHeight);
        for (int x = 0; x < 2 * kHeight; ++x) {
            const float value =
                transfer.towards(latLongDirection(x, y, 2 * kHeight, kHeight), bands);
            values.push_back(value);
            study.lowest = std::min(study.lowest, value);
            study.highest = std::max(study.highest, value);
            whole += solidAngle;
            if (value < 0.0f)
                negative += solidAngle;
        }
    }
    study.negativeShare = negative / whole;
    const float peak = std::max({study.highest, -study.lowest, 1e-6f});
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::vec3 color = shading::srgbEncode((values[i] < 0.0f ? kNegative : kPositive) *
                                                    std::abs(values[i]) / peak);
        picture.setPixel(static_cast<int>(i) % (2 * kHeight), static_cast<int>(i) / (2 * kHeight),
                         qRgb(static_cast<int>(255.0f * color.x + 0.5f),
                              static_cast<int>(255.0f * color.y + 0.5f),
                              static_cast<int>(255.0f * color.z + 0.5f)));
    }
    return picture;
}

// How much of the direction's light arrives: 0 or 1 by rays; by the transfer, over the cosine.
template <class Open>
QImage seenPicture(const QImage& environment, const Open& open) {
    QImage picture = environment.convertToFormat(QImage::Format_RGB32);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture.setPixel(x, y, blend(picture.pixel(x, y), 0.18 + 0.82 * open(x, y)));
    return picture;
}

} // namespace

std::shared_ptr<const TransferStudy> studyTransfer(const Document& document, const TransferAsk& ask,
                                                   const Luminance& luminance,
                                                   TransferMemory& memory, const JobContext& job) {
    auto study = std::make_shared<TransferStudy>();
    const std::optional<MeshPoint> point = nearestMeshPoint(document, ask.mesh, ask.position);
    const auto transfer =
        point ? pointTransfer(document, *ask.bake, *point) : std::optional<PointTransfer>();
    if (!transfer) {
        study->problem = QObject::tr("The bake has no values for this mesh; bake it again.");
        return study;
    }
    study->transfer = *transfer;
    const EnvironmentPart& mix = ask.environment;
    if (memory.environment != mix.image) {
        memory.analysis = analyseLight(mix.image, job);
        memory.environment = memory.analysis ? mix.image : nullptr;
    }
    if (!memory.analysis)
        return nullptr;
    LabLight lab{memory.analysis, nullptr, mix.rotationDeg};
    lab.setScale(mix.scale);
    study->lab = lab;

    // Environment and lights as coefficients, and what each band of them adds.
    const int order = transfer->order;
    std::map<ImagePtr, std::vector<glm::vec3>> projections;
    for (const EnvironmentPart& part : ask.parts) {
        const auto known = memory.projections.find(part.image);
        projections[part.image] =
            part.image == memory.environment    ? memory.analysis->bands.coefficients
            : known != memory.projections.end() ? known->second
                                                : projectLatLong(*part.image, kMaxShOrder, job);
    }
    if (job.cancelled())
        return nullptr;
    memory.projections = std::move(projections);
    study->light = transferLight(document, order,
                                 [&](const EnvironmentPart& part) -> std::span<const glm::vec3> {
                                     const auto known = memory.projections.find(part.image);
                                     if (known == memory.projections.end())
                                         return {};
                                     return known->second;
                                 });
    // Of local lights whose shadows are traced, transfer is asked for what bounces alone.
    const NearLightAt traced = nearLightAt(document, ask.shadows, *point);
    std::vector<glm::vec3> bouncing(study->light.size(), glm::vec3(0.0f));
    for (const Light& light : ask.lights)
        if (light.type != LightType::Directional)
            addNearLight(light, ask.position, order,
                         std::ranges::count(traced.lights, light.id) > 0 ? bouncing : study->light);
    const auto radiance = [&](unsigned bands) {
        return transfer->radiance(study->light, bands) + transfer->bouncedRadiance(bouncing, bands);
    };
    for (int l = 0; l < order; ++l)
        study->byBand.push_back(radiance(1u << static_cast<unsigned>(l)));
    study->radiance = radiance(ask.bands);
    study->local = traced.radiance;
    study->tracedLights = traced.lights.size();
    study->visibility = std::clamp(ambientVisibility(transfer->direct), 0.0f, 1.0f);

    const LabTone tone(document.view, luminance, 0.0f);
    const QSize size(2 * kHeight, kHeight);
    const QImage environment = labPicture(lab, {LabKind::Environment, 0}, size, tone, job);
    study->sum = labPicture(lab, {LabKind::Harmonics, ask.lightBands}, size, tone, job);
    study->lightLowest =
        lab.scale *
        memory.analysis->bands.sums[static_cast<std::size_t>(ask.lightBands - 1)].lowest;
    study->function = functionPicture(*transfer, ask.bands, *study);
    if (job.cancelled())
        return nullptr;
    if (ask.traced) {
        const Result<std::vector<bool>> visible =
            visibleDirections(bakeInputs(document), *point, kRayHeight, job);
        if (visible) {
            study->rays = 2 * kRayHeight * kRayHeight;
            study->seen = seenPicture(environment, [&](int x, int y) {
                const int from =
                    y * kRayHeight / kHeight * 2 * kRayHeight + x * kRayHeight / kHeight;
                return (*visible)[static_cast<std::size_t>(from)] ? 1.0 : 0.0;
            });
        }
    }
    if (study->seen.isNull()) {
        const float peak = std::max(study->highest, 1e-6f);
        study->seen = seenPicture(environment, [&](int x, int y) {
            const float value =
                transfer->towards(latLongDirection(x, y, 2 * kHeight, kHeight), ~0u);
            return static_cast<double>(std::clamp(value / peak, 0.0f, 1.0f));
        });
    }

    auto lobe = std::make_shared<render::SurfaceLobe>();
    lobe->mesh = std::make_shared<const LobeMesh>(
        lobeMesh(*transfer, ask.bands, std::max({study->highest, -study->lowest, 1e-6f})));
    lobe->position = ask.position; // its frame is the world's
    study->lobe = std::move(lobe);
    return study;
}

} // namespace patina::editor
