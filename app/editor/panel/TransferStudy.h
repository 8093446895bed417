// What the Transfer dock shows of one point: its coefficients and the pictures made of them. A
// value that is computed off the UI thread.
#pragma once

#include "app/editor/panel/LabLight.h"
#include "core/bake/document/TransferPoint.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"
#include "core/mix/LightMix.h"
#include "render/scene/SurfaceLobe.h"

#include <QImage>
#include <QString>
#include <map>
#include <memory>
#include <vector>

namespace patina::editor {

// All that a study is made of; equal asks have equal answers.
struct TransferAsk {
    BakeArtifactPtr bake;
    EnvironmentPart environment;        // as it is seen: of the pictures
    std::vector<EnvironmentPart> parts; // of the mix
    std::vector<Light> lights;          // that shine
    NearShadowsPtr shadows;             // of local ones, as they are shown; null: none
    Id mesh = 0;
    glm::vec3 position{0.0f}; // world
    bool traced = false;      // rays say what the point sees; else the transfer does
    unsigned bands = ~0u;     // of the transfer that are on
    int lightBands = 3;       // of the environment that is shown
    friend bool operator==(const TransferAsk&, const TransferAsk&) = default;
};

struct TransferStudy {
    QString problem; // why there is nothing; then the rest is empty
    PointTransfer transfer;
    std::vector<glm::vec3> light;  // that meets the point: environment and lights, as many as the
                                   // transfer has; without local lights whose shadows are traced
    std::vector<glm::vec3> byBand; // exit radiance of albedo 1 that each band adds
    glm::vec3 radiance{0.0f};      // of the bands that are on
    glm::vec3 local{0.0f};         // besides, of local lights whose shadows are traced
    std::size_t tracedLights = 0;
    float visibility = 1.0f;             // ambient, 0…1
    float lowest = 0.0f, highest = 0.0f; // of the transfer as a function of the direction
    double negativeShare = 0.0;          // of the sphere, where it is below zero
    int rays = 0;                        // that were traced; 0: the transfer said what is seen
    QImage seen;                         // environment, what is hidden is dark
    QImage function;                     // the transfer, below zero magenta
    QImage sum;                          // environment in lightBands bands, below zero magenta
    float lightLowest = 0.0f;            // of that sum
    LabLight lab;                        // what these pictures of the environment show
    std::shared_ptr<const render::SurfaceLobe> lobe;
};

// What was computed for an earlier study and may serve again; one thread at a time.
struct TransferMemory {
    ImagePtr environment;
    LabAnalysisPtr analysis;
    std::map<ImagePtr, std::vector<glm::vec3>> projections; // of the parts of the mix
};

// Null after a cancel.
[[nodiscard]] std::shared_ptr<const TransferStudy>
studyTransfer(const Document& document, const TransferAsk& ask, const Luminance& luminance,
              TransferMemory& memory, const JobContext& job);

} // namespace patina::editor
