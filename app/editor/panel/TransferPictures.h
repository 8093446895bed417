// What the Transfer dock shows of one point: a study with the pictures drawn of it. A value that is
// computed off the UI thread.
#pragma once

#include "app/editor/panel/LabLight.h"
#include "core/bake/study/TransferStudy.h"
#include "core/document/Document.h"
#include "core/document/ToneResponse.h"
#include "render/scene/SurfaceLobe.h"

#include <QImage>
#include <memory>

namespace patina::editor {

// All that the pictures depend on; equal requests have equal pictures.
struct TransferPicturesRequest {
    TransferRequest study;
    int lightBands = 3; // of the environment that is shown
    friend bool operator==(const TransferPicturesRequest&,
                           const TransferPicturesRequest&) = default;
};

struct TransferPictures {
    TransferStudy study;
    int rays = 0;             // that were traced; 0: the transfer said what is seen
    QImage seen;              // environment, what is hidden is dark
    QImage function;          // the transfer, below zero magenta
    QImage sum;               // environment in lightBands bands, below zero magenta
    float lightLowest = 0.0f; // of that sum
    LabLight lab;             // what these pictures of the environment show
    std::shared_ptr<const render::SurfaceLobe> lobe;
};

// What was computed for earlier pictures and may serve again; one thread at a time.
struct TransferPicturesMemory {
    TransferMemory study;
    EnvironmentAnalysisPtr analysis;
    LabReductionsPtr reductions; // of it
};

// Errors: those of studyTransfer().
Result<TransferPictures> drawTransfer(const Document& document,
                                      const TransferPicturesRequest& request,
                                      const Luminance& luminance, TransferPicturesMemory& memory,
                                      const JobContext& job);

} // namespace patina::editor
