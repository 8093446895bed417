#include "app/editor/viewport/EquationBar.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/viewport/EquationText.h"
#include "app/editor/viewport/TermTile.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/viewport/ViewThumb.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/FoldButton.h"
#include "core/document/ViewChoices.h"
#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/mix/LightMix.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QToolButton>
#include <QWheelEvent>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

using Terms = std::array<bool, kTermCount>;
const char* const kFoldedKey = "equationBar/folded";

bool allOn(const Terms& terms) {
    return std::all_of(terms.begin(), terms.end(), [](bool on) { return on; });
}

bool onlyOne(const Terms& terms, std::size_t term) {
    return terms[term] && std::count(terms.begin(), terms.end(), true) == 1;
}

QToolButton* makeCrumb(const QString& text) {
    auto* crumb = new QToolButton;
    crumb->setObjectName(QStringLiteral("crumb"));
    crumb->setText(text);
    crumb->setFocusPolicy(Qt::TabFocus);
    crumb->setAccessibleName(QObject::tr("Back to %1").arg(text));
    crumb->setToolTip(QObject::tr("Back to %1 (Esc: one step)").arg(text));
    return crumb;
}

} // namespace

EquationBar::EquationBar(ViewState& views, const TracedSide& traced, DocumentController& controller,
                         SheetScheduler& sheets, QWidget* parent)
    : QWidget(parent)
    , m_views(views)
    , m_traced(traced)
    , m_controller(controller)
    , m_sheets(&sheets)
    , m_fold(new FoldButton(tr("Equation"), QLatin1String(kFoldedKey)))
    , m_allOn(new QToolButton)
    , m_crumbs(new QWidget)
    , m_lacks(new ElidedLabel)
    , m_formula(new ElidedLabel)
    , m_note(new QLabel)
    , m_lights(new QComboBox)
    , m_scroll(new QScrollArea) {
    setObjectName(QStringLiteral("equationBar"));
    setAttribute(Qt::WA_StyledBackground);
    m_fold->setObjectName(QStringLiteral("foldEquation"));
    m_fold->setAccessibleName(tr("Show the picture as its sum"));
    m_fold->setToolTip(tr("Show or hide the picture as its sum (=)"));
    connect(m_fold, &QToolButton::clicked, this, [this] { setFolded(!isFolded()); });
    m_lacks->setObjectName(QStringLiteral("lacks"));
    m_lacks->setStyleSheet(QStringLiteral("color: %1").arg(QColor(tokens::kCopper).name()));
    m_formula->setObjectName(QStringLiteral("formula"));
    m_formula->setStyleSheet(QStringLiteral("color: %1").arg(QColor(tokens::kTextDim).name()));
    m_note->setObjectName(QStringLiteral("dim"));
    m_note->setWordWrap(true);
    m_note->setContentsMargins(tokens::kMargin, 0, tokens::kMargin, tokens::kGap);
    m_lights->setObjectName(QStringLiteral("small"));
    m_lights->setAccessibleName(tr("Light whose factors are shown"));
    m_lights->setToolTip(tr("The light whose factors are shown"));
    m_lights->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_lights, &QComboBox::activated, this, [this] {
        const Id light = m_lights->currentData().toUInt();
        m_views.edit([light](render::ViewSettings& settings) { settings.light = light; });
    });
    m_allOn->setObjectName(QStringLiteral("allTermsOn"));
    m_allOn->setText(tr("All On"));
    m_allOn->setAccessibleName(tr("All terms on"));
    m_allOn->setToolTip(tr("Make the picture of all its terms again (Alt+0)"));
    m_allOn->setFocusPolicy(Qt::TabFocus);
    connect(m_allOn, &QToolButton::clicked, this,
            [this] { m_views.edit([](render::ViewSettings& s) { s.terms.fill(true); }); });

    auto* crumbs = new QHBoxLayout(m_crumbs);
    crumbs->setContentsMargins(0, 0, 0, 0);
    crumbs->setSpacing(0);
    auto* header = new QHBoxLayout;
    header->setContentsMargins(tokens::kGap, 0, tokens::kGap, 0);
    header->setSpacing(tokens::kGap);
    header->addWidget(m_fold);
    header->addWidget(m_crumbs);
    header->addWidget(m_formula, 2);
    header->addWidget(m_lacks, 3); // whole where one term is missing
    header->addWidget(m_lights);
    header->addWidget(m_allOn);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 2, 0, 2);
    layout->setSpacing(2);
    layout->addLayout(header);
    layout->addWidget(m_note);
    layout->addWidget(m_scroll);
    m_scroll->setWidgetResizable(true);
    m_scroll->setFrameShape(QFrame::NoFrame);
    m_scroll->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_scroll->setFocusPolicy(Qt::NoFocus);
    m_scroll->viewport()->installEventFilter(this);
    connect(m_scroll->horizontalScrollBar(), &QScrollBar::valueChanged, m_sheets,
            &SheetScheduler::wake);

    connect(&m_views, &ViewState::changed, this, &EquationBar::refresh);
    connect(&m_traced, &TracedSide::changed, this, &EquationBar::refresh);
    connect(&m_traced.paths(), &PathView::modelChanged, this, &EquationBar::refresh);
    connect(&m_controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // what is shown is of the scene before
            m_pictures.clear();
            for (TermTile* tile : m_tiles)
                tile->thumb().setPicture({});
        }
        refresh();
    });
    m_sheets->add(*this);
    setFolded(m_fold->remembered(true));
}

EquationBar::~EquationBar() {
    if (m_sheets)
        m_sheets->remove(*this);
}

bool EquationBar::isFolded() const {
    return m_fold->isFolded();
}

void EquationBar::setFolded(bool folded) {
    m_fold->setFolded(folded);
    refresh();
    m_sheets->wake();
    Q_EMIT foldedChanged(folded);
}

// --- Opening ---------------------------------------------------------------------------------

void EquationBar::open(ViewKind kind) {
    m_path.push_back(kind);
    refresh();
    m_sheets->wake();
}

void EquationBar::close(std::size_t depth) {
    m_path.resize(std::min(depth + 1, m_path.size()));
    refresh();
    m_sheets->wake();
}

Equation EquationBar::equation() const {
    const Document& document = m_controller.document();
    const bool transmits = whyEmpty(shading::kViewThrough, document).empty();
    return *equationOf(opened(), document.model, transmits);
}

LightingMode EquationBar::lighting() const {
    return m_controller.document().view.lighting;
}

bool EquationBar::back() {
    if (m_path.size() < 2)
        return false;
    close(m_path.size() - 2);
    return true;
}

void EquationBar::keyPressEvent(QKeyEvent* event) {
    // Esc is the window's: it leads out of the split first, wherever the focus is.
    if (event->key() != Qt::Key_Backspace || !back())
        QWidget::keyPressEvent(event);
}

// --- What is shown ---------------------------------------------------------------------------

void EquationBar::refresh() {
    const Document& document = m_controller.document();
    // What does not apply any more is closed: its light is gone, or is solved.
    while (m_path.size() > 1 &&
           (!whyEmpty(opened(), document).empty() ||
            (opened() == shading::kViewDiffuseIbl && lighting() == LightingMode::Radiosity)))
        m_path.pop_back();
    if (chooseLight())
        return; // that has refreshed it
    refreshHeader();
    const Light* light = document.light(m_views.settings().light);
    const bool factors = !isOfOneLight(opened()) || (light && hasFactors(light->type));
    const std::optional<TracedBy> tracer = m_traced.wholeBy();
    m_note->setVisible(!isFolded() && (!factors || tracer));
    m_scroll->setVisible(!isFolded() && factors && !tracer);
    if (tracer)
        m_note->setText(tracedNoteText(*tracer));
    else if (!factors)
        m_note->setText(tr("The light of an area light comes from all over its surface and is "
                           "integrated over it: D, G, F and N·L of one direction are no factors "
                           "of it."));
    const Equation equation = this->equation();
    if (m_built != equation.parts.data() || m_builtFor != lighting())
        buildRow(equation);

    const render::ViewSettings& settings = m_views.settings();
    for (TermTile* tile : m_tiles) {
        ViewThumb& thumb = tile->thumb();
        thumb.setCurrent(thumb.kind() == settings.shown.kind,
                         settings.split && thumb.kind() == settings.split->other.kind);
        tile->setWhyEmpty(QString::fromStdString(whyEmpty(thumb.kind(), document, settings.light)));
    }
    if (opened() == shading::kViewFinal)
        for (std::size_t i = 0; i < kTermCount; ++i)
            m_tiles[i]->setOn(settings.terms[i], onlyOne(settings.terms, i));
}

void EquationBar::refreshHeader() {
    if (const std::optional<TracedBy> tracer = m_traced.wholeBy()) {
        for (QWidget* drawn : {static_cast<QWidget*>(m_allOn), static_cast<QWidget*>(m_lacks),
                               m_crumbs, static_cast<QWidget*>(m_lights)})
            drawn->hide();
        m_formula->setText(tracedFormulaText(*tracer, m_traced.paths().whitted().model));
        m_formula->setToolTip(tracedNoteText(*tracer));
        m_formula->show();
        return;
    }
    const Terms& terms = m_views.settings().terms;
    m_allOn->setVisible(!allOn(terms));
    m_lacks->setVisible(!allOn(terms));
    m_lacks->setText(allOn(terms) ? QString() : withoutText(terms, lighting()));
    m_lacks->setToolTip(m_lacks->text());
    // Folded it is the picture's sum, whatever is open. Beside that, what is lacking says it all.
    const bool isSum = isFolded() || opened() == shading::kViewFinal;
    m_formula->setVisible(!isSum || allOn(terms));
    m_formula->setText(formulaText(
        isSum ? *equationOf(shading::kViewFinal, m_controller.document().model) : equation(),
        lighting()));
    m_formula->setToolTip(m_formula->text());
    refreshCrumbs();
    refreshLights();
}

void EquationBar::refreshCrumbs() {
    m_crumbs->setVisible(m_path.size() > 1 && !isFolded());
    if (m_crumbsShown == m_path && m_builtFor == lighting())
        return;
    m_crumbsShown = m_path;
    QLayout* row = m_crumbs->layout();
    retireAll(*row);
    for (std::size_t depth = 0; depth + 1 < m_path.size(); ++depth) {
        QToolButton* crumb = makeCrumb(labelText(m_path[depth], lighting()));
        connect(crumb, &QToolButton::clicked, this, [this, depth] { close(depth); });
        row->addWidget(crumb);
        row->addWidget(new QLabel(QStringLiteral("›")));
    }
    auto* here = new QLabel(labelText(opened(), lighting()));
    here->setContentsMargins(4, 0, 0, 0);
    row->addWidget(here);
}

void EquationBar::refreshLights() {
    const Document& document = m_controller.document();
    const bool needed = isOfOneLight(opened()) && !isFolded();
    m_lights->setVisible(needed);
    if (!needed)
        return;
    const QSignalBlocker quiet(m_lights);
    m_lights->clear();
    for (const Light& light : document.lights)
        if (isActive(document, light))
            m_lights->addItem(QString::fromStdString(light.name), light.id);
    m_lights->setCurrentIndex(m_lights->findData(m_views.settings().light));
}

// The factors of direct light are those of one light.
bool EquationBar::chooseLight() {
    const Document& document = m_controller.document();
    const auto usable = [&](const Light& light, bool withFactors) {
        return isActive(document, light) && (hasFactors(light.type) || !withFactors);
    };
    const Light* chosen = document.light(m_views.settings().light);
    if (!isOfOneLight(opened()) || (chosen && isActive(document, *chosen)))
        return false;
    for (const bool withFactors : {true, false})
        for (const Light& light : document.lights)
            if (usable(light, withFactors)) {
                m_views.edit([&](render::ViewSettings& settings) { settings.light = light.id; });
                return true;
            }
    return false;
}

// --- The row ---------------------------------------------------------------------------------

void EquationBar::buildRow(const Equation& equation) {
    m_built = equation.parts.data();
    m_builtFor = lighting();
    m_tiles.clear();
    auto* contents = new QWidget;
    contents->setObjectName(QStringLiteral("panelContents"));
    auto* row = new QHBoxLayout(contents);
    row->setContentsMargins(tokens::kGap, 0, tokens::kGap, 0);
    row->setSpacing(2);
    const auto addText = [&](const QString& text) {
        if (text.isEmpty())
            return;
        auto* label = new QLabel(text);
        label->setObjectName(QStringLiteral("operator"));
        label->setAlignment(Qt::AlignCenter);
        row->addWidget(label);
    };
    for (std::size_t i = 0; i < equation.parts.size(); ++i) {
        addText(beforeText(equation, i));
        addPart(*row, equation.parts[i]);
    }
    addText(QStringLiteral("="));
    addTile(*row, new TermTile(equation.result, labelText(equation.result, lighting()), {}));
    row->addStretch(1);
    if (QWidget* before = m_scroll->widget()) {
        retire(before);
        m_scroll->takeWidget(); // or setWidget() would delete it at once
    }
    m_scroll->setWidget(contents);
    m_scroll->setFixedHeight(m_tiles.front()->sizeHint().height() +
                             m_scroll->horizontalScrollBar()->sizeHint().height());
}

void EquationBar::addPart(QBoxLayout& row, const EquationPart& part) {
    const bool isTerm = opened() == shading::kViewFinal;
    // Radiosity is solved, not multiplied.
    const bool solved =
        part.kind == shading::kViewDiffuseIbl && lighting() == LightingMode::Radiosity;
    const bool opens = !solved && equationOf(part.kind, m_controller.document().model).has_value();
    TermTile* tile =
        addTile(row, new TermTile(part.kind, partText(part, lighting()), {isTerm, opens}));
    connect(tile, &TermTile::opened, this, [this, kind = part.kind] { open(kind); });
    if (!isTerm)
        return;
    const std::size_t term = m_tiles.size() - 1; // parts of the sum are kTermViews
    connect(tile, &TermTile::switched, this, [this, term](bool on) {
        m_views.edit([=](render::ViewSettings& settings) { settings.terms[term] = on; });
    });
    connect(tile, &TermTile::soloClicked, this, [this, term] { solo(term); });
}

TermTile* EquationBar::addTile(QBoxLayout& row, TermTile* tile) {
    ViewThumb& thumb = tile->thumb();
    if (const auto picture = m_pictures.find(thumb.kind()); picture != m_pictures.end())
        thumb.setPicture(picture->second);
    connect(&thumb, &ViewThumb::clicked, this, [this, kind = thumb.kind()] { m_views.show(kind); });
    thumb.installEventFilter(this);
    row.addWidget(tile);
    m_tiles.push_back(tile);
    return tile;
}

void EquationBar::solo(std::size_t term) {
    const Terms terms = m_views.settings().terms;
    Terms next{};
    if (onlyOne(terms, term)) {
        next = m_beforeSolo;
    } else {
        // From one solo to the next: what was before the first one comes back.
        if (std::count(terms.begin(), terms.end(), true) > 1)
            m_beforeSolo = terms;
        next[term] = true;
    }
    m_views.edit([&](render::ViewSettings& settings) { settings.terms = next; });
    // Alone in the picture; not behind a view of something else.
    m_views.show(shading::kViewFinal);
}

// --- Thumbnails ------------------------------------------------------------------------------

render::ViewSheet EquationBar::wantedSheet() const {
    const double ratio = devicePixelRatioF();
    render::ViewSheet sheet;
    sheet.width = qRound(ViewThumb::kSmallPicture.width() * ratio);
    sheet.height = qRound(ViewThumb::kSmallPicture.height() * ratio);
    // What it comes to is looked at first.
    for (auto tile = m_tiles.rbegin(); tile != m_tiles.rend(); ++tile) {
        const ViewThumb& thumb = std::as_const(**tile).thumb();
        if (!thumb.isEmpty() && !thumb.visibleRegion().isEmpty())
            sheet.kinds.push_back(thumb.kind());
    }
    return sheet;
}

void EquationBar::showThumbnail(ViewKind kind, const QImage& picture) {
    m_pictures[kind] = picture;
    for (TermTile* tile : m_tiles)
        if (tile->thumb().kind() == kind)
            tile->thumb().setPicture(picture);
}

void EquationBar::showEvent(QShowEvent*) {
    m_sheets->wake();
}

bool EquationBar::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize || event->type() == QEvent::Show)
        m_sheets->wake();
    // The wheel turns sideways: there is nothing to scroll the other way.
    if (event->type() == QEvent::Wheel && watched == m_scroll->viewport()) {
        scrollSideways(*m_scroll, *static_cast<QWheelEvent*>(event));
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace patina::editor
