#include "app/editor/trace/PathBadge.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/trace/TracedTexts.h"
#include "app/editor/trace/WhittedHeat.h"
#include "app/editor/viewport/SplitHandle.h"
#include "app/editor/widget/ControlHelp.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kShownLetters = 15; // of what is shown: it hides the picture

} // namespace

PathBadge::PathBadge(PathView& paths, PathError& error, WhittedHeat& heat, TracedSide& side,
                     QPushButton* remedy, QWidget& viewport)
    : QFrame(&viewport)
    , m_paths(paths)
    , m_error(error)
    , m_heat(heat)
    , m_side(side)
    , m_viewport(viewport)
    , m_text(new QLabel)
    , m_shown(new QComboBox)
    , m_whittedShown(new QComboBox)
    , m_boxes(new QSpinBox)
    , m_save(new QPushButton(tr("Save…")))
    , m_pause(new QPushButton(tr("Pause"))) {
    setObjectName(QStringLiteral("pathBadge"));
    setProperty("overlay", true);
    setAccessibleName(tr("Path tracing"));
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, tokens::kGap);
    column->setSpacing(tokens::kGap / 2);
    m_text->setObjectName(QStringLiteral("pathBadgeText"));
    column->addWidget(m_text);
    auto* row = new QHBoxLayout;
    row->setSpacing(tokens::kGap);
    column->addLayout(row);
    m_shown->setObjectName(QStringLiteral("pathShown"));
    m_shown->setAccessibleName(tr("Shown of the traced picture"));
    m_shown->setToolTip(
        tr("The traced picture, the one that the viewport draws, or how far that is from the "
           "traced one. Hold Space to see the drawn one."));
    m_shown->setStatusTip(m_shown->toolTip());
    m_shown->setFocusPolicy(Qt::TabFocus); // keys stay the viewport's
    for (const auto& [picture, name] : std::initializer_list<std::pair<PathPicture, QString>>{
             {PathPicture::Traced, tr("Path traced")},
             {PathPicture::Drawn, tr("Viewport")},
             {PathPicture::Exposure, tr("Too bright, too dark")},
             {PathPicture::Relative, tr("Relative error")},
             {PathPicture::Visible, tr("Visible difference")}})
        m_shown->addItem(name, static_cast<int>(picture));
    connect(m_shown, &QComboBox::activated, this, [this](int index) {
        m_error.setShown(static_cast<PathPicture>(m_shown->itemData(index).toInt()));
    });
    row->addWidget(m_shown);
    addWhitted(*row);
    row->addWidget(remedy);
    row->addStretch(1);
    m_save->setObjectName(QStringLiteral("pathSave"));
    m_save->setFocusPolicy(Qt::TabFocus);
    m_save->setAccessibleName(tr("Save the traced picture"));
    m_save->setToolTip(tr("Save the traced picture as it is now: as displayed, linear, or with its "
                          "parts"));
    m_save->setStatusTip(m_save->toolTip());
    connect(m_save, &QPushButton::clicked, this, &PathBadge::saveWanted);
    row->addWidget(m_save);
    m_pause->setObjectName(QStringLiteral("pathPause"));
    m_pause->setCheckable(true);
    m_pause->setAccessibleName(tr("Pause path tracing"));
    m_pause->setToolTip(tr("Let the picture rest as it is; a change of the scene goes on"));
    m_pause->setStatusTip(m_pause->toolTip());
    row->addWidget(m_pause);
    connect(m_pause, &QPushButton::clicked, &paths, &PathView::setPaused);
    connect(&paths, &PathView::changed, this, &PathBadge::refresh);
    connect(&error, &PathError::changed, this, &PathBadge::refresh);
    connect(&heat, &WhittedHeat::changed, this, &PathBadge::refresh);
    connect(&side.views(), &ViewState::changed, this, &PathBadge::refresh);
    connect(&side, &TracedSide::changed, this, &PathBadge::refresh);
    viewport.installEventFilter(this);
    refresh();
}

void PathBadge::addWhitted(QBoxLayout& row) {
    describe(m_whittedShown, tr("Shown of the Whitted picture"),
             tr("The picture, or what each of its pixels takes: rays, depth of the tree, boxes and "
                "triangles tested, with the hierarchy of boxes and without"));
    m_whittedShown->setObjectName(QStringLiteral("whittedShown"));
    m_whittedShown->setFocusPolicy(Qt::TabFocus);
    m_whittedShown->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_whittedShown->setMinimumContentsLength(kShownLetters);
    m_whittedShown->addItem(tr("Picture"));
    for (const RayCountInfo& info : rayCountInfos())
        m_whittedShown->addItem(toQString(std::string(info.label)), static_cast<int>(info.kind));
    connect(m_whittedShown, &QComboBox::activated, this, [this](int index) {
        const QVariant kind = m_whittedShown->itemData(index);
        m_heat.setShown(kind.isValid() ? std::optional(static_cast<RayCountKind>(kind.toInt()))
                                       : std::nullopt);
    });
    row.addWidget(m_whittedShown);
    describe(m_boxes, tr("Level of boxes"),
             tr("Draws the bounding boxes of one level of the hierarchy; level 0 is the scene's"));
    m_boxes->setObjectName(QStringLiteral("whittedBoxes"));
    m_boxes->setFocusPolicy(Qt::ClickFocus);
    m_boxes->setPrefix(tr("Boxes: level "));
    m_boxes->setSpecialValueText(tr("No boxes"));
    m_boxes->setRange(-1, 1);
    m_boxes->setValue(-1);
    connect(m_boxes, &QSpinBox::valueChanged, this, [this](int level) {
        m_heat.setLevel(level < 0 ? std::nullopt : std::optional(level));
    });
    row.addWidget(m_boxes);
}

QString PathBadge::text() const {
    if (!m_side.showsPicture())
        return (m_paths.isWhitted() ? tr("Whitted") : tr("Path traced")) +
               tr(": the picture alone. This view is drawn as usual.");
    return tracedText(m_paths.tracer(), m_paths.progress(),
                      m_side.side() ? TracedRoom::Side : TracedRoom::Whole);
}

void PathBadge::refresh() {
    setVisible(m_paths.isOn());
    m_text->setText(text());
    const QString help = tracedHelp(m_paths.tracer(), m_paths.progress());
    m_text->setToolTip(m_paths.isWhitted()
                           ? help + tr(" Open the Ray Tree dock and click a pixel to see its rays.")
                           : help);
    m_shown->setCurrentIndex(m_shown->findData(static_cast<int>(m_error.shown())));
    m_save->setEnabled(m_paths.progress().samples > 0);
    m_pause->setChecked(m_paths.isPaused());
    m_pause->setText(m_paths.isPaused() ? tr("Resume") : tr("Pause"));
    m_pause->setVisible(!m_paths.progress().refined &&
                        (!m_paths.isWhitted() || m_paths.progress().noise));
    const bool whole = !m_side.side(); // what covers the picture leaves no room for another side
    m_shown->setVisible(whole && !m_paths.isWhitted()); // which is no measure of the drawn one
    m_whittedShown->setVisible(whole && m_paths.isWhitted());
    m_whittedShown->setCurrentIndex(
        m_heat.shown() ? m_whittedShown->findData(static_cast<int>(*m_heat.shown())) : 0);
    m_boxes->setVisible(whole && m_paths.isWhitted());
    if (const auto counted = m_heat.counted()) // how many levels there are is known then
        m_boxes->setMaximum(std::max(counted->deepestLevel, 1));
    place();
}

void PathBadge::place() {
    adjustSize();
    const auto& split = m_side.views().settings().split;
    const bool right = m_side.side() && split &&
                       (SplitLine(*split, m_viewport.size()).right.x() >= 0.0) ==
                           (m_side.side() == ViewSide::Other);
    const int farRight = std::max(m_viewport.width() - width() - tokens::kMargin, tokens::kMargin);
    move(right ? farRight : tokens::kMargin, m_viewport.height() - height() - tokens::kMargin);
    raise();
}

bool PathBadge::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible())
        place();
    return false;
}

} // namespace patina::editor
