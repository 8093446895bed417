#include "app/editor/panel/ParameterList.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/Section.h"
#include "core/base/Check.h"

#include <QVBoxLayout>
#include <algorithm>
#include <set>

namespace patina::editor {

ParameterList::ParameterList(DocumentController& controller, Thumbnails& thumbnails,
                             ParameterListSpec spec, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_spec(std::move(spec)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);

    std::vector<const ParameterInfo*> infos;
    std::set<std::string_view> groups;
    int labelWidth = 0;
    for (const ParameterInfo& info : parameters()) {
        if ((info.scope != m_spec.scope && info.scope != m_spec.alignedWith) ||
            info.type == ParameterType::Reference || info.type == ParameterType::Text)
            continue;
        // Labels of rows that stand elsewhere in the dock count, so that all columns agree.
        labelWidth = std::max(labelWidth, fontMetrics().horizontalAdvance(toQString(info.label)));
        if (info.scope != m_spec.scope ||
            std::count(m_spec.without.begin(), m_spec.without.end(), info.id) > 0)
            continue;
        infos.push_back(&info);
        groups.insert(info.group);
    }

    const RowContext context{controller, thumbnails, m_spec.target, labelWidth + 2};
    std::string_view group;
    Section* section = nullptr;
    for (const ParameterInfo* info : infos) {
        ParameterRow* row = makeParameterRow(*info, context);
        m_rows.push_back(row);
        // A lone group usually needs no heading: the dock has one.
        if ((groups.size() > 1 || m_spec.loneHeading) && info->group != group) {
            section = new Section(toQString(info->group));
            layout->addWidget(section);
            m_sections.push_back({section, {}});
            group = info->group;
        }
        if (section) {
            section->add(row);
            m_sections.back().second.push_back(row);
        } else {
            layout->addWidget(row);
        }
    }
    connect(&controller, &DocumentController::changed, this, &ParameterList::documentChanged);
    refresh();
}

ParameterRow* ParameterList::row(std::string_view id) const {
    const auto found = std::find_if(m_rows.begin(), m_rows.end(),
                                    [&](const ParameterRow* row) { return row->info().id == id; });
    return found == m_rows.end() ? nullptr : *found;
}

void ParameterList::addBelow(std::string_view id, QWidget* widget) {
    ParameterRow* above = row(id);
    CHECK(above != nullptr);
    auto* rows = qobject_cast<QBoxLayout*>(above->parentWidget()->layout());
    CHECK(rows != nullptr);
    rows->insertWidget(rows->indexOf(above) + 1, widget);
}

void ParameterList::documentChanged(const Change& change) {
    if (change.isAnotherDocument()) // another document, in which ids mean others
        abandonEdits(*this);
    // An edit of another element concerns no row here; one of the shading model may make rows of
    // materials useful or useless.
    if (change.target && change.target != m_spec.target()) {
        if (change.target->scope == Scope::Model)
            refreshVisibility();
        return;
    }
    refresh();
}

void ParameterList::refresh() {
    for (ParameterRow* row : m_rows)
        row->refresh();
    refreshVisibility();
}

void ParameterList::refreshVisibility() {
    const auto target = m_spec.target();
    const Document& document = m_controller.document();
    if (!target || !targetExists(document, *target))
        return;
    const auto holds = [&](const Condition* condition) {
        return condition == nullptr || condition->holds(document, target->id);
    };
    for (ParameterRow* row : m_rows) {
        row->setWorks(holds(row->info().works));
        const bool applies = holds(row->info().applies);
        if (!applies)
            abandonEdits(*row);
        row->setVisible(applies);
    }
    // A heading without a row would only be in the way.
    for (const auto& [section, rows] : m_sections)
        section->setVisible(std::any_of(rows.begin(), rows.end(),
                                        [](const ParameterRow* row) { return !row->isHidden(); }));
}

} // namespace patina::editor
