// The environments that the library shows, as the grid's model.
#pragma once

#include <QAbstractListModel>
#include <QCache>
#include <QPixmap>
#include <QStringList>

namespace patina::editor {

class EnvironmentLibrary;
struct LibraryItem;

class LibraryModel : public QAbstractListModel {
    Q_OBJECT
  public:
    enum Role {
        SourceRole = Qt::UserRole,
        SubtitleRole, // the number that is sorted by
        FavouriteRole,
        CurrentRole,  // it lights the scene
        RotationRole, // degrees, of that one; of others invalid
        DuplicateRole,
        PictureRole // QPixmap, null while it is not measured
    };

    explicit LibraryModel(EnvironmentLibrary& library, QObject* parent = nullptr);

    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
    [[nodiscard]] QStringList mimeTypes() const override;
    [[nodiscard]] QMimeData* mimeData(const QModelIndexList& indexes) const override;
    [[nodiscard]] Qt::DropActions supportedDragActions() const override { return Qt::CopyAction; }

    [[nodiscard]] QModelIndex indexOf(const QString& source) const; // invalid: it is not shown

  private:
    [[nodiscard]] const LibraryItem* at(const QModelIndex& index) const;
    [[nodiscard]] QPixmap picture(const LibraryItem& item) const;
    void follow();

    EnvironmentLibrary& m_library;
    QStringList m_rows; // sources, as the views know them
    // Made when they are painted for the first time.
    mutable QCache<QString, std::pair<const void*, QPixmap>> m_pictures;
};

} // namespace patina::editor
