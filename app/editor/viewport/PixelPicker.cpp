#include "app/editor/viewport/PixelPicker.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/PinMarker.h"
#include "core/base/Log.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kLookMs = 33;         // between two looks, at least
constexpr double kLookShare = 0.25; // of the time, at most, while something is dragged

// Many window managers keep Alt + click for themselves.
bool pinsWith(Qt::KeyboardModifiers modifiers) {
    return modifiers == (Qt::ControlModifier | Qt::ShiftModifier) || modifiers == Qt::AltModifier;
}

} // namespace

PixelPicker::PixelPicker(DocumentController& controller, QWidget& viewport, FrameSchedule& schedule)
    : m_controller(controller)
    , m_viewport(viewport)
    , m_mark(new PinMarker(viewport))
    , m_look(schedule, [this] { look(); }) {
    viewport.installEventFilter(this);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // another document
            m_pointer.reset();
            m_pinLater.reset();
            unpin();
            if (m_probe)
                m_probe->setHover(std::nullopt);
        }
        m_outdated = m_outdated || change.affects != Affects::Nothing;
        placeMark();
    });
}

void PixelPicker::setProbe(PixelProbe& probe) {
    m_probe = &probe;
    connect(&probe, &PixelProbe::wantedChanged, this, &PixelPicker::lookSoon);
    connect(&probe, &PixelProbe::pinChanged, this, [this] {
        if (!m_probe->pin() && m_pin) { // a panel took it away
            m_pin.reset();
            m_clicked.reset();
            placeMark();
            lookSoon();
        }
    });
}

// --- When ----------------------------------------------------------------------------------------

void PixelPicker::frameDrawn(const QSize& size, bool moving) {
    const Camera& camera = m_controller.document().view.camera;
    m_cameraRests = camera == m_camera;
    m_camera = camera;
    m_outdated = false;
    m_frame = size;
    m_moving = moving;
    lookSoon();
}

void PixelPicker::setReady(bool ready) {
    if (ready == m_ready)
        return;
    m_ready = ready;
    lookSoon();
}

// Never at once: this is also called while a frame is drawn. While something is dragged, frames
// have the larger part of the time.
void PixelPicker::lookSoon() {
    if (!m_probe || !(m_probe->wanted() || m_pinLater) || m_look.isWanted())
        return;
    if (!m_ready) {
        Q_EMIT notReady();
        return;
    }
    const double pause =
        std::max<double>(kLookMs, m_moving ? m_lookMs / kLookShare - m_lookMs : 0.0);
    const auto since = m_sinceLook.isValid() ? static_cast<double>(m_sinceLook.elapsed()) : pause;
    m_look.want(std::max(0.0, pause - since));
}

void PixelPicker::look() {
    if (m_ready && m_pinLater && !m_frame.isEmpty())
        pinAt(*std::exchange(m_pinLater, std::nullopt));
    if (!m_probe || !m_probe->wanted() || m_frame.isEmpty() || !m_ready)
        return;
    // The numbers belong to the picture that is shown. A newer one is on its way, and then its
    // numbers are wanted.
    if (m_outdated || m_controller.document().view.camera != m_camera)
        return;
    if (m_pin) {
        lookAtPin();
    } else if (m_pointer && (m_cameraRests || !m_moving) && !m_dragging) {
        if (const auto pixel = pixelAt(*m_pointer))
            if (auto inspection = inspect(*pixel))
                m_probe->setHover(std::move(inspection));
    }
}

void PixelPicker::lookAtPin() {
    const Document& document = m_controller.document();
    if (!m_pin->position(document)) { // its mesh is gone
        unpin();
        return;
    }
    refinePin();
    const auto place = m_pin->place(document, QSizeF(m_frame));
    if (!place) {
        m_probe->setPinState(PinState::Outside);
    } else if (auto there = inspect({static_cast<int>(place->x()), static_cast<int>(place->y())})) {
        if (m_pin->isSeen(*there, document))
            m_probe->setPin(std::move(there));
        else
            m_probe->setPinState(PinState::Hidden);
    }
    placeMark();
}

void PixelPicker::refinePin() {
    const Document& document = m_controller.document();
    if (!m_clicked)
        return;
    if (document.view.camera != m_clicked->camera ||
        m_pin->position(document) != m_clicked->position) { // something else is there now
        m_clicked.reset();
        return;
    }
    const auto pixel = pixelAt(m_clicked->at);
    if (!pixel || m_frame.width() <= m_clicked->frame.width())
        return;
    // Beside the silhouette, a finer pixel may show what is behind: the pin stays on its mesh.
    if (const auto there = inspect(*pixel); there && there->mesh == m_pin->mesh()) {
        m_pin.emplace(*there, document);
        m_clicked->position = *m_pin->position(document);
    }
    m_clicked->frame = m_frame;
}

std::optional<render::Inspection> PixelPicker::inspect(const QPoint& pixel) {
    if (!m_inspect || !QRect(QPoint(), m_frame).contains(pixel))
        return std::nullopt;
    QElapsedTimer clock;
    clock.start();
    Result<render::Inspection> inspection = m_inspect(pixel);
    m_lookMs = static_cast<double>(clock.nsecsElapsed()) * 1e-6;
    m_sinceLook.start();
    if (inspection)
        return std::move(*inspection);
    logError("the pixel could not be looked at: {}", inspection.error().text());
    return std::nullopt;
}

std::optional<QPoint> PixelPicker::pixelAt(const QPointF& position) const {
    if (m_frame.isEmpty() || !QRectF(m_viewport.rect()).contains(position))
        return std::nullopt;
    const QPoint pixel(static_cast<int>(position.x() * m_frame.width() / m_viewport.width()),
                       static_cast<int>(position.y() * m_frame.height() / m_viewport.height()));
    return QRect(QPoint(), m_frame).contains(pixel) ? std::optional(pixel) : std::nullopt;
}

// --- The pin -------------------------------------------------------------------------------------

void PixelPicker::placeMark() {
    if (!m_pin) {
        m_mark->setPlace(std::nullopt);
        return;
    }
    m_mark->setPlace(m_pin->place(m_controller.document(), QSizeF(m_viewport.size())));
    m_mark->setBroken(m_probe && m_probe->pinState() == PinState::Hidden);
    m_mark->raise();
}

void PixelPicker::unpin() {
    m_pin.reset();
    m_clicked.reset();
    placeMark();
    if (m_probe && m_probe->pin())
        m_probe->setPin(std::nullopt);
}

void PixelPicker::togglePin() {
    if (m_pin)
        unpin();
    else if (m_pointer)
        pinAt(*m_pointer);
    lookSoon();
}

void PixelPicker::pinAt(const QPointF& at) {
    const auto pixel = pixelAt(at);
    if (!m_probe || !pixel)
        return;
    if (!m_ready) {
        m_pinLater = at;
        Q_EMIT notReady();
        return;
    }
    std::optional<render::Inspection> inspection = inspect(*pixel);
    if (!inspection)
        return;
    if (!inspection->onSurface()) {
        unpin();
        return;
    }
    const Document& document = m_controller.document();
    m_pin.emplace(*inspection, document);
    m_clicked.reset();
    if (const auto position = m_pin->position(document))
        m_clicked = {at, m_frame, m_camera, *position};
    m_probe->setPin(std::move(inspection));
    placeMark();
    Q_EMIT pinned();
}

void PixelPicker::setPicking(bool picking) {
    if (picking == m_picking)
        return;
    m_picking = picking;
    if (picking)
        m_viewport.setCursor(Qt::CrossCursor);
    else
        m_viewport.unsetCursor();
    Q_EMIT pickingChanged(picking);
}

// --- The hand ------------------------------------------------------------------------------------

bool PixelPicker::eventFilter(QObject*, QEvent* event) {
    switch (event->type()) {
    case QEvent::MouseButtonPress: {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() == Qt::LeftButton && (m_picking || pinsWith(mouse->modifiers()))) {
            m_pointer = mouse->position();
            setPicking(false);
            pinAt(mouse->position());
            return true;
        }
        m_dragging = true;
        return false;
    }
    case QEvent::MouseButtonRelease:
        m_dragging = false;
        lookSoon();
        return false;
    case QEvent::MouseMove: {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        m_dragging = mouse->buttons() != Qt::NoButton;
        m_pointer = mouse->position();
        if (!m_dragging)
            lookSoon();
        return m_picking && !m_dragging; // the cursor is ours
    }
    case QEvent::ShortcutOverride:
        if (m_picking && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape) {
            setPicking(false);
            event->accept();
            return true;
        }
        return false;
    case QEvent::Resize:
        placeMark();
        return false;
    default:
        return false;
    }
}

} // namespace patina::editor
