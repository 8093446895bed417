#include "app/editor/panel/ExplanationModel.h"

#include "app/editor/style/Tokens.h"
#include "core/math/Shading.h"

#include <QColor>
#include <QFont>
#include <QFontDatabase>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kNumberWidth = 9; // characters

QString numbersText(const std::vector<float>& numbers) {
    QString text;
    for (const float number : numbers)
        text += QString::fromStdString(render::numberText(number)).rightJustified(kNumberWidth);
    return text;
}

QFont numberFont() {
    QFont font = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    font.setPointSizeF(QFont().pointSizeF() * 0.92); // three of them fit a narrow dock
    return font;
}

QColor displayColor(const std::vector<float>& linear) {
    const auto channel = [&](std::size_t i) {
        return std::isfinite(linear[i]) ? shading::srgbEncode(linear[i]) : 0.0f;
    };
    return QColor::fromRgbF(channel(0), channel(1), channel(2));
}

} // namespace

int ExplanationModel::add(std::vector<Node>& nodes, int parent, Node node) const {
    const auto index = static_cast<int>(nodes.size());
    node.parent = parent;
    if (parent >= 0) {
        Node& above = nodes[static_cast<std::size_t>(parent)];
        node.row = static_cast<int>(above.children.size());
        node.key = above.key + QLatin1Char('/') + node.key;
        above.children.push_back(index);
    }
    nodes.push_back(std::move(node));
    return index;
}

void ExplanationModel::addValue(std::vector<Node>& nodes, int parent,
                                const render::ExplainedValue& value) const {
    Node node;
    node.kind = Kind::Value;
    node.key = QString::fromStdString(value.key);
    node.name = QString::fromStdString(value.label);
    node.symbol = QString::fromStdString(value.symbol);
    node.numbers =
        value.numbers.empty() ? QString::fromStdString(value.text) : numbersText(value.numbers);
    node.unit = QString::fromStdString(value.unit);
    if (value.isColor && value.numbers.size() == 3)
        node.color = displayColor(value.numbers);
    add(nodes, parent, std::move(node));
}

void ExplanationModel::addStep(std::vector<Node>& nodes, int parent,
                               const render::ExplainedStep& step) const {
    Node node;
    node.kind = Kind::Step;
    node.key = QString::fromStdString(step.key);
    node.name = QString::fromStdString(step.label);
    node.symbol = QString::fromStdString(step.result.symbol);
    node.numbers = step.result.numbers.empty() ? QString::fromStdString(step.result.text)
                                               : numbersText(step.result.numbers);
    node.unit = QString::fromStdString(step.result.unit);
    if (step.result.isColor && step.result.numbers.size() == 3)
        node.color = displayColor(step.result.numbers);
    node.agrees = step.agrees;
    node.help = QString::fromStdString(step.formula);
    if (!step.agrees && step.recomputed)
        node.help += tr("\nThe CPU computes %1").arg(numbersText(*step.recomputed).trimmed());
    const int index = add(nodes, parent, std::move(node));
    const auto line = [&](Kind kind, const char* key, const std::string& text) {
        if (text.empty())
            return;
        Node words;
        words.kind = kind;
        words.key = QLatin1String(key);
        words.name = QString::fromStdString(text);
        words.help = words.name;
        add(nodes, index, std::move(words));
    };
    line(Kind::Formula, "formula", step.formula.empty() ? "" : "= " + step.formula);
    for (const render::ExplainedValue& factor : step.factors)
        addValue(nodes, index, factor);
    line(Kind::Note, "note", step.note);
}

void ExplanationModel::setExplanation(const render::Explanation& explanation) {
    std::vector<Node> nodes;
    std::vector<int> sections;
    for (const render::ExplainedSection& section : explanation.sections) {
        Node node;
        node.key = QString::fromStdString(section.key);
        node.name = QString::fromStdString(section.title);
        node.row = static_cast<int>(sections.size());
        const int index = add(nodes, -1, std::move(node));
        sections.push_back(index);
        for (const render::ExplainedValue& value : section.values)
            addValue(nodes, index, value);
        for (const render::ExplainedStep& step : section.steps)
            addStep(nodes, index, step);
    }
    const bool sameShape = std::equal(
        nodes.begin(), nodes.end(), m_nodes.begin(), m_nodes.end(),
        [](const Node& a, const Node& b) { return a.key == b.key && a.parent == b.parent; });
    if (!sameShape)
        beginResetModel();
    m_nodes = std::move(nodes);
    m_sections = std::move(sections);
    if (!sameShape) {
        endResetModel();
        return;
    }
    const auto changed = [this](const std::vector<int>& rows, const QModelIndex& parent) {
        if (!rows.empty())
            Q_EMIT dataChanged(index(0, 0, parent),
                               index(static_cast<int>(rows.size()) - 1, ColumnCount - 1, parent));
    };
    changed(m_sections, {});
    for (std::size_t i = 0; i < m_nodes.size(); ++i)
        changed(m_nodes[i].children, createIndex(m_nodes[i].row, 0, static_cast<quintptr>(i)));
}

QModelIndex ExplanationModel::find(const QString& key) const {
    for (std::size_t i = 0; i < m_nodes.size(); ++i)
        if (m_nodes[i].key == key)
            return createIndex(m_nodes[i].row, 0, static_cast<quintptr>(i));
    return {};
}

const ExplanationModel::Node* ExplanationModel::node(const QModelIndex& index) const {
    return index.isValid() ? &m_nodes[static_cast<std::size_t>(index.internalId())] : nullptr;
}

QModelIndex ExplanationModel::index(int row, int column, const QModelIndex& parent) const {
    const Node* above = node(parent);
    const std::vector<int>& rows = above ? above->children : m_sections;
    if (row < 0 || row >= static_cast<int>(rows.size()) || column < 0 || column >= ColumnCount)
        return {};
    return createIndex(row, column, static_cast<quintptr>(rows[static_cast<std::size_t>(row)]));
}

QModelIndex ExplanationModel::parent(const QModelIndex& index) const {
    const Node* child = node(index);
    if (!child || child->parent < 0)
        return {};
    const Node& above = m_nodes[static_cast<std::size_t>(child->parent)];
    return createIndex(above.row, 0, static_cast<quintptr>(child->parent));
}

int ExplanationModel::rowCount(const QModelIndex& parent) const {
    if (parent.column() > 0)
        return 0;
    const Node* above = node(parent);
    return static_cast<int>(above ? above->children.size() : m_sections.size());
}

int ExplanationModel::columnCount(const QModelIndex&) const {
    return ColumnCount;
}

QVariant ExplanationModel::data(const QModelIndex& index, int role) const {
    const Node* n = node(index);
    if (!n)
        return {};
    const bool isName = index.column() == Name;
    switch (role) {
    case KeyRole:
        return n->key;
    case KindRole:
        return static_cast<int>(n->kind);
    case Qt::DisplayRole:
        if (!isName)
            return n->unit.isEmpty() ? n->numbers : n->numbers + QStringLiteral("  ") + n->unit;
        return n->symbol.isEmpty() || n->symbol == n->name ? n->name
                                                           : tr("%1  %2").arg(n->name, n->symbol);
    case Qt::DecorationRole:
        return !isName && n->color.isValid() ? QVariant(n->color) : QVariant();
    case Qt::ToolTipRole:
        return n->help.isEmpty() ? QVariant() : QVariant(n->help);
    case Qt::ForegroundRole:
        if (!n->agrees)
            return QColor(tokens::kDanger);
        if (n->kind == Kind::Formula || n->kind == Kind::Note)
            return QColor(tokens::kTextDim);
        return {};
    case Qt::FontRole: {
        if (!isName)
            return numberFont();
        QFont font;
        font.setBold(n->kind == Kind::Section);
        font.setItalic(n->kind == Kind::Formula);
        return font;
    }
    default:
        return {};
    }
}

} // namespace patina::editor
