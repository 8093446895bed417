#include "app/editor/trace/PathError.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/trace/PathView.h"
#include "core/document/DisplayedPicture.h"
#include "core/document/Document.h"
#include "core/document/ToneResponse.h"

#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kErrorTag = "error of the drawn picture";

QImage displayed(const Image& image) {
    const bool alpha = image.channels() == 4;
    return QImage(image.u8().data(), image.width(), image.height(),
                  image.channels() * image.width(),
                  alpha ? QImage::Format_RGBA8888 : QImage::Format_RGB888)
        .copy();
}

// Whether both show radiance alike; the camera is the traced picture's.
bool sameDisplay(View a, const View& b) {
    a.camera = b.camera;
    return a == b;
}

} // namespace

PathError::PathError(DocumentController& controller, PathView& paths, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_paths(paths)
    , m_tasks(controller.runner()) {
    connect(&paths, &PathView::changed, this, [this] {
        if (!m_paths.isOn() || m_paths.isWhitted()) { // which is no measure of light
            setShown(PathPicture::Traced);
            m_peeking = false;
        } else if (m_paths.number() != m_ofTraced) {
            m_ofTraced = m_paths.number();
            outdate(); // another camera, perhaps
        } else {
            measure();
        }
    });
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.affects != Affects::Nothing)
            outdate();
    });
}

bool PathError::isOn() const {
    return m_paths.isOn() && (m_shown != PathPicture::Traced || m_peeking);
}

void PathError::setShown(PathPicture shown) {
    if (shown == m_shown)
        return;
    m_shown = shown;
    m_paths.setTellsCertainty(shown != PathPicture::Traced);
    if (shown == PathPicture::Traced) {
        m_tasks.cancelAll();
        m_drawn = nullptr;
        m_measured = nullptr;
        m_problem.clear();
        m_has = 0;
    } else if (wantsDrawn()) {
        Q_EMIT drawnWanted();
    }
    Q_EMIT changed();
}

void PathError::setPeeking(bool peeking) {
    if (peeking == m_peeking || m_shown == PathPicture::Traced)
        return;
    m_peeking = peeking;
    Q_EMIT changed();
}

void PathError::outdate() {
    ++m_wanted;
    if (!isOn())
        return;
    m_tasks.cancelAll();
    Q_EMIT drawnWanted();
    Q_EMIT changed();
}

bool PathError::wantsDrawn() const {
    return isOn() && m_has != m_wanted && m_paths.picture() != nullptr;
}

void PathError::setDrawn(Image drawn) {
    if (!isOn())
        return;
    m_has = m_wanted;
    m_drawn = std::make_shared<const Image>(std::move(drawn));
    measure();
}

// The newest pictures; again when they have changed meanwhile.
void PathError::measure() {
    const PathView::Reference& reference = m_paths.reference();
    if (!isOn() || m_has != m_wanted || !reference.traced || m_tasks.busy(kErrorTag))
        return;
    const View view = m_controller.document().view;
    if (m_measured && m_measured->drawn == m_drawn && m_measured->traced == reference.traced &&
        sameDisplay(m_measuredView, view))
        return;
    m_tasks.run(
        {.tag = kErrorTag},
        [drawn = m_drawn, reference, view](const JobContext& job) {
            return work(drawn, reference.traced, *reference.materials, view, job);
        },
        [this, view, wanted = m_wanted](const Result<std::shared_ptr<const Measured>>& measured) {
            if (wanted != m_wanted)
                return;
            m_measured = measured ? *measured : nullptr;
            m_problem = measured ? QString() : toQString(measured.error().message);
            m_measuredView = view;
            Q_EMIT changed();
            if (measured)
                measure();
        });
}

Result<std::shared_ptr<const PathError::Measured>>
PathError::work(std::shared_ptr<const Image> drawn, std::shared_ptr<const TracedPicture> traced,
                const std::vector<Id>& materials, const View& view, const JobContext& job) {
    Result<PictureError> error = pictureError(*drawn, *traced, view, materials, job);
    if (!error)
        return error.error();
    const Result<Image> shown = displayedPicture(*drawn, view, luminanceOf(traced->radiance));
    if (!shown)
        return shown.error();
    auto measured = std::make_shared<Measured>();
    measured->exposure = displayed(errorPicture(*error, ErrorShown::Exposure));
    measured->relative = displayed(errorPicture(*error, ErrorShown::Relative));
    measured->visible = displayed(errorPicture(*error, ErrorShown::Visible));
    measured->shownDrawn = displayed(*shown);
    measured->drawn = std::move(drawn);
    measured->traced = std::move(traced);
    measured->error = *std::move(error);
    return std::shared_ptr<const Measured>(std::move(measured));
}

QImage PathError::picture() const {
    if (!isOn() || !m_measured)
        return {};
    switch (m_peeking ? PathPicture::Drawn : m_shown) {
    case PathPicture::Drawn:
        return m_measured->shownDrawn;
    case PathPicture::Exposure:
        return m_measured->exposure;
    case PathPicture::Relative:
        return m_measured->relative;
    case PathPicture::Visible:
        return m_measured->visible;
    case PathPicture::Traced:
        break;
    }
    return {};
}

} // namespace patina::editor
