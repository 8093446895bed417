// The document's meshes and materials as a tree of two branches. Reads the document, stores
// nothing but the shape of the tree it last told its views about.
#pragma once

#include "core/edit/Change.h"

#include <QAbstractItemModel>
#include <QColor>
#include <QIcon>

namespace patina {
struct Material;
}

namespace patina::editor {

class DocumentController;
class Thumbnails;

class SceneModel : public QAbstractItemModel {
    Q_OBJECT
  public:
    enum Branch { Meshes = 0, Materials = 1 };
    // Marks: of a mesh its eye, of a material that it lacks files.
    enum Column { NameColumn = 0, MaterialColumn = 1, MarkColumn = 2, ColumnCount = 3 };

    SceneModel(DocumentController& controller, Thumbnails& thumbnails, QObject* parent = nullptr);

    [[nodiscard]] QModelIndex branchIndex(Branch branch) const;
    [[nodiscard]] QModelIndex indexOf(Target target) const; // invalid when it is gone
    [[nodiscard]] std::optional<Target> targetAt(const QModelIndex& index) const;

    [[nodiscard]] QModelIndex index(int row, int column,
                                    const QModelIndex& parent = {}) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& index) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
    // Materials can be dragged, and dropped onto meshes.
    [[nodiscard]] QStringList mimeTypes() const override;
    [[nodiscard]] QMimeData* mimeData(const QModelIndexList& indexes) const override;
    [[nodiscard]] bool canDropMimeData(const QMimeData* data, Qt::DropAction action, int row,
                                       int column, const QModelIndex& parent) const override;
    bool dropMimeData(const QMimeData* data, Qt::DropAction action, int row, int column,
                      const QModelIndex& parent) override;

  private:
    void documentChanged(const Change& change);
    [[nodiscard]] QVariant meshData(std::size_t row, int column, int role) const;
    [[nodiscard]] QVariant materialData(std::size_t row, int column, int role) const;

    [[nodiscard]] QColor colorOf(const Material& material) const;

    DocumentController& m_controller;
    Thumbnails& m_thumbnails;
    QIcon m_meshIcon, m_eyeIcon, m_eyeOffIcon, m_warningIcon;
    int m_counts[2] = {0, 0};
};

} // namespace patina::editor
