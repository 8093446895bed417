#include "app/editor/panel/LensComparison.h"

#include "app/editor/document/QtText.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/PlotStyle.h"
#include "core/material/ModelPresets.h"

#include <QHBoxLayout>
#include <QIcon>
#include <QMenu>
#include <QPixmap>
#include <QToolButton>
#include <algorithm>

namespace patina::editor {
namespace {

const ModelPreset& preset(int index) {
    return modelPresets()[static_cast<std::size_t>(index)];
}

// A stroke as the look's curves have it.
QIcon sampleOf(int slot) {
    QPixmap pixmap(44, 24);
    pixmap.setDevicePixelRatio(2.0);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(plotPen(slot, 2.0));
    painter.drawLine(QPointF(1, 6), QPointF(21, 6));
    return pixmap;
}

void help(QAction* action, const QString& sentence) {
    action->setToolTip(sentence);
    action->setStatusTip(sentence);
}

} // namespace

LensComparison::LensComparison(std::function<std::optional<LensLook>()> shown, QObject* parent)
    : QObject(parent)
    , m_shown(std::move(shown))
    , m_button(new QToolButton)
    , m_menu(new QMenu(m_button))
    , m_legend(new QWidget)
    , m_row(new QHBoxLayout(m_legend)) {
    m_button->setObjectName(QStringLiteral("raised"));
    m_button->setText(tr(" Compare "));
    m_button->setAccessibleName(tr("Compare"));
    m_button->setToolTip(tr("Put up to three other shading models, or the material as it is now, "
                            "beside the scene's"));
    m_button->setStatusTip(m_button->toolTip());
    m_button->setPopupMode(QToolButton::InstantPopup);
    m_button->setFocusPolicy(Qt::TabFocus);
    m_button->setMenu(m_menu);
    m_menu->setToolTipsVisible(true);
    connect(m_menu, &QMenu::aboutToShow, this, &LensComparison::fillMenu);
    m_row->setContentsMargins(0, 0, 0, 0);
    m_row->setSpacing(2);
    fillLegend();
}

std::vector<LensComparison::Entry>::iterator LensComparison::find(const Entry& entry) {
    return std::find_if(m_entries.begin(), m_entries.end(), [&](const Entry& e) {
        return e.kind == entry.kind && (e.kind != Kind::Preset || e.preset == entry.preset);
    });
}

QString LensComparison::nameOf(const Entry& entry) {
    switch (entry.kind) {
    case Kind::Preset:
        return toQString(preset(entry.preset).title);
    case Kind::SingleScatter:
        return tr("No compensation");
    case Kind::Frozen:
        break;
    }
    return tr("Frozen");
}

ShadingModel LensComparison::modelOf(const Entry& entry, const ShadingModel& model) {
    if (entry.kind == Kind::SingleScatter)
        return withCompensation(model, false);
    if (entry.kind == Kind::Frozen)
        return entry.frozen.model;
    // The preset's choices; the numbers stay the document's.
    ShadingModel result = preset(entry.preset).model;
    result.f90 = model.f90;
    result.ior = model.ior;
    result.conductorN = model.conductorN;
    result.conductorK = model.conductorK;
    return result;
}

std::vector<LensComparison::Look> LensComparison::looks(const ShadingModel& model) const {
    std::vector<Look> looks{{0, tr("Scene"), model, std::nullopt}};
    for (const Entry& entry : m_entries)
        looks.push_back(
            {entry.slot, nameOf(entry), modelOf(entry, model),
             entry.kind == Kind::Frozen ? std::optional(entry.frozen.point) : std::nullopt});
    return looks;
}

void LensComparison::toggle(const Entry& entry, bool compare) {
    const auto known = find(entry);
    if (known != m_entries.end()) {
        if (compare) // frozen anew, in the same colour
            known->frozen = entry.frozen;
        else
            m_entries.erase(known);
    } else if (compare) {
        if (static_cast<int>(m_entries.size()) == kPlotLooks - 1)
            m_entries.erase(m_entries.begin()); // the oldest makes room
        Entry added = entry;
        for (added.slot = 1; added.slot < kPlotLooks; ++added.slot)
            if (std::none_of(m_entries.begin(), m_entries.end(),
                             [&](const Entry& e) { return e.slot == added.slot; }))
                break;
        m_entries.push_back(added);
    }
    fillLegend();
    Q_EMIT changed();
}

void LensComparison::clear() {
    m_entries.clear();
    fillLegend();
    Q_EMIT changed();
}

void LensComparison::fillMenu() {
    m_menu->clear();
    const auto addChoice = [this](const Entry& entry, const QString& sentence) {
        QAction* action = m_menu->addAction(nameOf(entry));
        help(action, sentence);
        action->setCheckable(true);
        action->setChecked(find(entry) != m_entries.end());
        connect(action, &QAction::triggered, this,
                [this, entry](bool checked) { toggle(entry, checked); });
    };
    for (int i = 0; i < static_cast<int>(modelPresets().size()); ++i)
        addChoice({Kind::Preset, i, 1, {}}, toQString(preset(i).help));
    m_menu->addSeparator();
    addChoice({Kind::SingleScatter, 0, 1, {}}, tr("The scene's model, light scattered once only"));
    m_menu->addSeparator();
    QAction* freeze = m_menu->addAction(tr("Freeze as It Is Now"), this, [this] {
        if (const std::optional<LensLook> shown = m_shown())
            toggle({Kind::Frozen, 0, 1, *shown}, true);
    });
    help(freeze, tr("Keep the material and its model as they are, to compare with what you do "
                    "next"));
    QAction* nothing = m_menu->addAction(tr("Compare with Nothing"), this, &LensComparison::clear);
    help(nothing, tr("Show the scene's material alone"));
    nothing->setEnabled(!m_entries.empty());
}

void LensComparison::fillLegend() {
    retireAll(*m_row);
    const auto add = [this](int slot, const QString& name, const QString& sentence) {
        auto* entry = new QToolButton;
        entry->setIcon(sampleOf(slot));
        entry->setIconSize({22, 12});
        entry->setText(name);
        entry->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        entry->setToolTip(sentence);
        entry->setStatusTip(sentence);
        entry->setAccessibleName(tr("Legend: %1").arg(name));
        entry->setFocusPolicy(slot == 0 ? Qt::NoFocus : Qt::TabFocus);
        m_row->addWidget(entry);
        return entry;
    };
    add(0, tr("Scene"), tr("The selected material with the scene's shading model"));
    for (const Entry& entry : m_entries)
        connect(add(entry.slot, nameOf(entry), tr("Click to compare with it no longer")),
                &QToolButton::clicked, this, [this, entry] { toggle(entry, false); });
    m_legend->updateGeometry();
}

} // namespace patina::editor
