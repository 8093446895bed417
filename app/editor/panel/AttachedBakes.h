// The bakes that are attached to the scene: what each holds, whether it is up to date, and if not,
// why; baking again what is stale, all at once or one by one; going on with what was stopped.
#pragma once

#include "core/bake/document/BakeStaleness.h"

#include <QWidget>
#include <functional>

class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class BakeService;
class DocumentController;

class AttachedBakes : public QWidget {
    Q_OBJECT
  public:
    // `wanted`: what the form asks for of a kind; a bake with other settings says so. `resume` goes
    // on with a bake that was stopped.
    AttachedBakes(DocumentController& controller, BakeService& bakes,
                  std::function<BakeRequest(BakeKind)> wanted,
                  std::function<void(const BakeRequest&)> resume, QWidget* parent = nullptr);

    void refresh();
    // Whether a row offers to go on with this bake.
    [[nodiscard]] bool offers(const BakeRequest& request) const;

  private:
    void addRow(const BakeArtifact& bake, const BakeStaleness& staleness);
    void addAbsentRow(const BakeArtifact& bake);
    QPushButton* removeButton(BakeKind kind);

    DocumentController& m_controller;
    BakeService& m_bakes;
    std::function<BakeRequest(BakeKind)> m_wanted;
    std::function<void(const BakeRequest&)> m_resume;
    QVBoxLayout* m_rows;
};

} // namespace patina::editor
