// A button beside the error of the drawn picture: bakes what the viewport lacks to know of hidden
// and reflected light, lights with it, and says by how much the error fell.
#pragma once

#include "core/document/Document.h"

#include <QPushButton>
#include <QSize>
#include <memory>
#include <optional>

namespace patina::editor {

class BakeService;
class DocumentController;
class PathBlame;
class PathError;

class TransferRemedy : public QPushButton {
    Q_OBJECT
  public:
    TransferRemedy(PathError& error, PathBlame& blame, DocumentController& controller,
                   BakeService& bakes, QWidget* parent = nullptr);

    // Of the picture before the remedy, while its success is not known yet: FLIP.
    [[nodiscard]] std::optional<double> before() const {
        return m_before ? std::optional(m_before->flip) : std::nullopt;
    }

  private:
    struct Before {
        double flip = 0.0;
        QSize size;     // of the pictures
        Document scene; // camera included
    };
    // Only pictures of one scene, camera and size can be compared.
    [[nodiscard]] bool isComparable(const Before& before) const;
    void refresh();
    void apply();       // bakes where there is no bake
    void light();       // with the bake
    void tellSuccess(); // once the new picture has been measured
    // Of the causes of the error that it reduces; nothing while they are not known.
    [[nodiscard]] std::optional<double> reducedShare() const;
    [[nodiscard]] bool isDone() const; // the bake is there, and lights

    PathError& m_error;
    PathBlame& m_blame;
    DocumentController& m_controller;
    BakeService& m_bakes;
    bool m_waits = false; // for the bake, to light with it
    std::optional<Before> m_before;
    std::shared_ptr<const void> m_replaced; // what was measured before
};

} // namespace patina::editor
