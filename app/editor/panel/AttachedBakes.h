// The bakes that are attached to the scene: whether each is up to date, and if not, why; baking
// again what is stale, all at once or one by one.
#pragma once

#include "core/bake/BakeStaleness.h"

#include <QWidget>
#include <functional>

class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class BakeRunner;
class DocumentController;

class AttachedBakes : public QWidget {
    Q_OBJECT
  public:
    // `wanted`: what would be asked for of a kind; a bake with other settings is stale.
    AttachedBakes(DocumentController& controller, BakeRunner& runner,
                  std::function<BakeRequest(BakeKind)> wanted, QWidget* parent = nullptr);

    void refresh();

  private:
    void addRow(const BakeArtifact& bake, const BakeStaleness& staleness);
    void addAbsentRow(const BakeArtifact& bake);
    QPushButton* removeButton(BakeKind kind);
    [[nodiscard]] BakeRequest again(const BakeArtifact& bake, const BakeStaleness& why) const;

    DocumentController& m_controller;
    BakeRunner& m_runner;
    std::function<BakeRequest(BakeKind)> m_wanted;
    QVBoxLayout* m_rows;
};

} // namespace patina::editor
