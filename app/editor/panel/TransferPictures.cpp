#include "app/editor/panel/TransferPictures.h"

#include "app/editor/panel/LabDrawing.h"
#include "core/bake/study/TransferLobe.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kPictureHeight = 192; // of the pictures of the environment
const TransferColors kTransferColors{{0.35f, 0.75f, 0.66f}, {0.92f, 0.2f, 0.75f}};

QRgb blend(QRgb color, double light) {
    return qRgb(static_cast<int>(qRed(color) * light), static_cast<int>(qGreen(color) * light),
                static_cast<int>(qBlue(color) * light));
}

// Green as it lets light through, magenta where it would take some away.
QImage functionPicture(const TransferFunction& function) {
    const int height = function.height, width = 2 * height;
    QImage picture(width, height, QImage::Format_RGB32);
    const float peak = function.peak();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float value = function.values[static_cast<std::size_t>(y * width + x)];
            const glm::vec3 color = shading::srgbEncode(
                (value < 0.0f ? kTransferColors.negative : kTransferColors.positive) *
                std::abs(value) / peak);
            picture.setPixel(x, y,
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

Result<TransferPictures> drawTransfer(const Document& document,
                                      const TransferPicturesRequest& request,
                                      const Luminance& luminance, TransferPicturesMemory& memory,
                                      const JobContext& job) {
    Result<TransferStudy> studied = studyTransfer(document, request.study, memory.study, job);
    if (!studied)
        return studied.error();
    TransferPictures pictures;
    TransferStudy& study = pictures.study = *std::move(studied);
    if (memory.analysis != study.environment.analysis) {
        memory.reductions = reduceForPictures(*study.environment.analysis, job);
        memory.analysis = memory.reductions ? study.environment.analysis : nullptr;
    }
    const Error cancelled{ErrorKind::Cancelled, "pictures of a point were cancelled", {}, {}};
    if (!memory.reductions)
        return cancelled;
    pictures.lab = {study.environment, memory.reductions};

    const LabTone tone(document.view, luminance, 0.0f);
    const QSize size(2 * kPictureHeight, kPictureHeight);
    const QImage environment = labPicture(pictures.lab, {LabKind::Environment, 0}, size, tone, job);
    pictures.sum =
        labPicture(pictures.lab, {LabKind::Harmonics, request.lightBands}, size, tone, job);
    pictures.lightLowest =
        static_cast<float>(study.environment.bandSumError(request.lightBands).lowest);
    pictures.function = functionPicture(study.function);
    if (job.cancelled())
        return cancelled;
    if (!study.visible.empty()) {
        const int rows = study.visibleHeight;
        pictures.rays = 2 * rows * rows;
        pictures.seen = seenPicture(environment, [&](int x, int y) {
            const int from = y * rows / kPictureHeight * 2 * rows + x * rows / kPictureHeight;
            return study.visible[static_cast<std::size_t>(from)] ? 1.0 : 0.0;
        });
    } else {
        const float peak = std::max(study.function.highest, 1e-6f);
        pictures.seen = seenPicture(environment, [&](int x, int y) {
            const float value = study.transfer.towards(
                latLongDirection(x, y, 2 * kPictureHeight, kPictureHeight), ~0u);
            return static_cast<double>(std::clamp(value / peak, 0.0f, 1.0f));
        });
    }

    auto lobe = std::make_shared<render::SurfaceLobe>();
    lobe->mesh = std::make_shared<const LobeMesh>(
        transferLobe(study.transfer, request.study.bands, study.function.peak(), kTransferColors));
    lobe->position = request.study.position; // its frame is the world's
    pictures.lobe = std::move(lobe);
    return pictures;
}

} // namespace patina::editor
