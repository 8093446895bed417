// An explanation as a tree for views: sections, their values, and formulas that open into their
// factors. What is shown stays open while the numbers change.
#pragma once

#include "render/view/Explanation.h"

#include <QAbstractItemModel>
#include <QColor>
#include <vector>

namespace patina::editor {

class ExplanationModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Column { Name, Numbers, ColumnCount };
    enum class Kind { Section, Value, Step, Formula, Note };
    enum Role { KeyRole = Qt::UserRole, KindRole }; // path of keys: "environment/diffuseIbl"

    explicit ExplanationModel(QObject* parent = nullptr)
        : QAbstractItemModel(parent) {}

    void setExplanation(const render::Explanation& explanation);

    [[nodiscard]] QModelIndex find(const QString& key) const; // invalid: there is none

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

  private:
    struct Node {
        Kind kind = Kind::Section;
        int parent = -1, row = 0;
        std::vector<int> children;
        QString key, name, symbol, numbers, unit, help;
        QColor color; // of a colour; invalid: none
        bool agrees = true;
    };
    int add(std::vector<Node>& nodes, int parent, Node node) const;
    void addValue(std::vector<Node>& nodes, int parent, const render::ExplainedValue& value) const;
    void addStep(std::vector<Node>& nodes, int parent, const render::ExplainedStep& step) const;
    [[nodiscard]] const Node* node(const QModelIndex& index) const;

    std::vector<Node> m_nodes;
    std::vector<int> m_sections;
};

} // namespace patina::editor
