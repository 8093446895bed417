#include "app/editor/panel/EnvironmentPanel.h"

#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/EnvironmentList.h"
#include "app/editor/panel/ParameterList.h"
#include "app/editor/panel/SoftboxList.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/LatLongPicture.h"
#include "app/editor/widget/LatLongView.h"
#include "app/editor/widget/MapSlotWidget.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/SkyGallery.h"
#include "app/editor/widget/TextButton.h"
#include "core/document/Source.h"
#include "core/edit/EditSession.h"

#include <QButtonGroup>
#include <QDateTime>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr Target kEnvironment{Scope::Environment, 0};

} // namespace

EnvironmentPanel::EnvironmentPanel(DocumentController& controller, Thumbnails& thumbnails,
                                   QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_off(makeOff())
    , m_view(new LatLongView)
    , m_picture(new LatLongPicture(controller.runner(), this))
    , m_gallery(new SkyGallery)
    , m_source(new ElidedLabel)
    , m_imageControls(makeImageControls())
    , m_softboxes(new SoftboxList(controller, thumbnails))
    , m_parameters(new ParameterList(controller, thumbnails,
                                     {Scope::Environment,
                                      [] { return std::optional(kEnvironment); },
                                      // shown above, or by the mixer, in another way
                                      {"environment.kind", "environment.image"}})) {
    m_gallery->setRunner(controller.runner());
    auto* scroll = new PanelScroll;
    scroll->contents()->addWidget(new EnvironmentList(controller));
    scroll->contents()->addWidget(m_off);
    scroll->contents()->addWidget(makeKinds());
    scroll->contents()->addWidget(m_view);
    scroll->contents()->addWidget(m_imageControls);
    scroll->contents()->addWidget(m_softboxes);
    scroll->contents()->addWidget(m_parameters);
    scroll->contents()->addStretch(1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(m_picture, &LatLongPicture::changed, this,
            [this] { m_view->setPicture(m_picture->picture()); });
    connect(m_softboxes, &SoftboxList::selectionChanged, this,
            [this] { m_view->setSelected(m_softboxes->selected()); });
    connectView();
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // another document
            abandonEdits(*m_view);
            m_session = 0;
            m_before.clear();
        }
        if (!change.target || change.target->scope == Scope::Environment ||
            change.target->scope == Scope::Softbox)
            refresh();
    });
    refresh();
}

QWidget* EnvironmentPanel::makeOff() {
    auto* off = new QWidget;
    auto* row = new QHBoxLayout(off);
    row->setContentsMargins(0, 0, 0, 0);
    auto* says = new QLabel(tr("Switched off: it lights nothing."));
    says->setWordWrap(true);
    row->addWidget(says, 1);
    QPushButton* on = makeTextButton(tr("Switch On"), tr("Light the scene with the environment"));
    on->setObjectName(QStringLiteral("environmentOn"));
    connect(on, &QPushButton::clicked, this, [this] {
        m_controller.setParameter(parameter("environment.enabled"), kEnvironment, true);
    });
    row->addWidget(on);
    return off;
}

QWidget* EnvironmentPanel::makeKinds() {
    auto* kinds = new QWidget;
    auto* row = new QHBoxLayout(kinds);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    auto* group = new QButtonGroup(kinds);
    const ParameterInfo& info = parameter("environment.kind");
    const QString tips[] = {tr("Light the scene with a photographed environment"),
                            tr("Light the scene with a clear sky and its sun"),
                            tr("Light the scene with softboxes in a dark room")};
    for (std::size_t i = 0; i < m_kinds.size(); ++i) {
        auto* button = m_kinds[i] = new QToolButton;
        button->setObjectName(QStringLiteral("segment"));
        button->setText(toQString(info.choiceLabels[i]));
        button->setToolTip(tips[i]);
        button->setStatusTip(tips[i]);
        button->setAccessibleName(tr("Environment kind %1").arg(button->text()));
        button->setCheckable(true);
        button->setFocusPolicy(Qt::TabFocus);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        group->addButton(button);
        row->addWidget(button);
        connect(button, &QToolButton::clicked, this, [this, i] {
            m_controller.setEnvironmentKind(static_cast<EnvironmentKind>(i));
            if (m_softboxes->selected() == 0)
                m_softboxes->selectFirst();
            refresh(); // the mark follows the document, not the click
        });
    }
    auto* save = new QToolButton;
    save->setIcon(icon(QStringLiteral("save-as")));
    save->setToolTip(tr("Write the environment as an HDR or EXR file of any layout"));
    save->setStatusTip(save->toolTip());
    save->setAccessibleName(tr("Save the environment"));
    save->setFocusPolicy(Qt::TabFocus);
    row->addSpacing(tokens::kGap);
    row->addWidget(save);
    connect(save, &QToolButton::clicked, this, &EnvironmentPanel::saveRequested);
    return kinds;
}

QWidget* EnvironmentPanel::makeImageControls() {
    auto* browseButton = new QPushButton(icon(QStringLiteral("open")), tr("Browse…"));
    browseButton->setToolTip(tr("Light the scene with an HDR or EXR panorama from a file"));
    browseButton->setStatusTip(browseButton->toolTip());
    browseButton->setAccessibleName(tr("Choose an environment file"));
    auto* controls = new QWidget;
    auto* layout = new QVBoxLayout(controls);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(tokens::kGap);
    layout->addWidget(m_gallery);
    QPushButton* extract = makeTextButton(
        tr("Extract Sun"), tr("Make the image's brightest source a light, and remove it from the "
                              "image; once more: the next one"));
    extract->setIcon(icon(QStringLiteral("light-sun")));
    connect(extract, &QPushButton::clicked, &m_controller, &DocumentController::extractSun);
    auto* file = new QHBoxLayout;
    file->addWidget(m_source, 1);
    file->addWidget(browseButton);
    layout->addLayout(file);
    layout->addWidget(extract, 0, Qt::AlignLeft);
    connect(m_gallery, &SkyGallery::chosen, this, [this](const QString& source) {
        m_controller.setEnvironment(source);
        refresh(); // the mark follows the document, not the click
    });
    connect(browseButton, &QPushButton::clicked, this, &EnvironmentPanel::browse);
    return controls;
}

void EnvironmentPanel::connectView() {
    connect(m_view, &LatLongView::dragStarted, this, [this] {
        m_session = m_controller.newDragSession();
        m_before.clear();
    });
    connect(m_view, &LatLongView::dragFinished, this, [this] { m_session = 0; });
    connect(m_view, &LatLongView::dragCancelled, this, &EnvironmentPanel::cancelDrag);
    connect(m_view, &LatLongView::turned, this, [this](double degrees) {
        edit(kEnvironment, {{&parameter("environment.rotationDeg"), static_cast<float>(degrees)}},
             tr("Rotate Environment"));
    });
    connect(m_view, &LatLongView::sunMoved, this, [this](double azimuth, double elevation) {
        edit(kEnvironment,
             {{&parameter("environment.skySunAzimuthDeg"), static_cast<float>(azimuth)},
              {&parameter("environment.skySunElevationDeg"), static_cast<float>(elevation)}},
             tr("Move Sun"));
    });
    connect(m_view, &LatLongView::softboxShaped, this, [this](const Softbox& softbox) {
        edit({Scope::Softbox, softbox.id},
             {{&parameter("softbox.azimuthDeg"), softbox.azimuthDeg},
              {&parameter("softbox.elevationDeg"), softbox.elevationDeg},
              {&parameter("softbox.widthDeg"), softbox.widthDeg},
              {&parameter("softbox.heightDeg"), softbox.heightDeg},
              {&parameter("softbox.rollDeg"), softbox.rollDeg}},
             tr("Place %1").arg(QString::fromStdString(softbox.name)));
    });
    connect(m_view, &LatLongView::softboxSelected, m_softboxes, &SoftboxList::select);
    connect(m_view, &LatLongView::removeRequested, m_softboxes, &SoftboxList::remove);
    connect(m_view, &LatLongView::addRequested, this, [this](double azimuth, double elevation) {
        m_softboxes->select(
            m_controller.addSoftbox(static_cast<float>(azimuth), static_cast<float>(elevation)));
    });
    connect(m_view, &LatLongView::resized, this, &EnvironmentPanel::refreshPicture);
}

void EnvironmentPanel::edit(Target target, const std::vector<ParameterEdit>& edits,
                            const QString& text) {
    DragSession session = m_session;
    if (session == 0) {
        const qint64 now = QDateTime::currentMSecsSinceEpoch();
        if (m_stepSession == 0 || now - m_lastStepMs > kStepPauseMs)
            m_stepSession = m_controller.newDragSession();
        m_lastStepMs = now;
        session = m_stepSession;
    } else if (m_before.empty()) {
        m_editTarget = target;
        for (const ParameterEdit& each : edits)
            m_before.push_back({each.info, each.info->get(m_controller.document(), target.id)});
    }
    m_controller.setParameters(target, edits, text, session);
}

// The values from before merge with the drag's step, which then leaves nothing behind.
void EnvironmentPanel::cancelDrag() {
    if (!m_before.empty())
        m_controller.setParameters(m_editTarget, m_before, {}, m_session);
    m_session = 0;
}

void EnvironmentPanel::refresh() {
    const Environment& environment = m_controller.document().environment();
    for (std::size_t i = 0; i < m_kinds.size(); ++i)
        m_kinds[i]->setChecked(i == static_cast<std::size_t>(environment.kind));
    m_off->setVisible(!environment.enabled);
    m_imageControls->setVisible(environment.kind == EnvironmentKind::Image);
    m_softboxes->setVisible(environment.kind == EnvironmentKind::Softboxes);
    m_view->setEnvironment(environment);
    refreshPicture();

    const QString source = QString::fromStdString(environment.source);
    if (environment.kind == EnvironmentKind::Image && environment.problem.empty() &&
        environment.fileImage && !environment.source.empty() && !isBuiltin(environment.source))
        m_gallery->addRecent(source, environment.fileImage);
    m_gallery->setCurrent(source);
    m_source->setText(MapSlotWidget::sourceTitle(environment.source));
    const bool broken = !environment.problem.empty();
    m_source->setToolTip(
        broken ? source + QLatin1Char('\n') + QString::fromStdString(environment.problem) : source);
    QPalette colors = m_source->palette();
    colors.setColor(QPalette::WindowText, QColor(broken ? tokens::kCopper : tokens::kTextDim));
    m_source->setPalette(colors);
}

void EnvironmentPanel::refreshPicture() {
    if (!isVisible())
        return; // made when it is seen
    const Environment& environment = m_controller.document().environment();
    m_picture->show(environment.image, environment.exposureEv,
                    std::max(64, qRound(m_view->width() * m_view->devicePixelRatioF())));
}

void EnvironmentPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    refreshPicture();
}

void EnvironmentPanel::browse() {
    const QString key = QStringLiteral("folders/environments");
    auto* dialog = new QFileDialog(window(), tr("Choose Environment"),
                                   proposedFolder(m_controller, key), environmentFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    connect(dialog, &QFileDialog::fileSelected, this, [this, key](const QString& file) {
        rememberFolder(m_controller, key, file);
        m_controller.setEnvironment(file);
    });
    dialog->open();
}

} // namespace patina::editor
