#include "app/editor/library/LibraryModel.h"

#include "app/editor/document/DraggedSources.h"
#include "app/editor/document/QtText.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "app/editor/library/LibraryTexts.h"

#include <QImage>
#include <QMimeData>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kKeptPictures = 400; // of 128 KB each

} // namespace

LibraryModel::LibraryModel(EnvironmentLibrary& library, QObject* parent)
    : QAbstractListModel(parent)
    , m_library(library)
    , m_pictures(kKeptPictures) {
    connect(&library, &EnvironmentLibrary::itemsChanged, this, &LibraryModel::follow);
    connect(&library, &EnvironmentLibrary::currentChanged, this, [this] {
        if (!m_rows.isEmpty())
            Q_EMIT dataChanged(index(0), index(rowCount() - 1), {CurrentRole, RotationRole});
    });
    connect(&library, &EnvironmentLibrary::rotated, this, [this] {
        if (const QModelIndex current = indexOf(m_library.current()); current.isValid())
            Q_EMIT dataChanged(current, current, {RotationRole});
    });
    follow();
}

void LibraryModel::follow() {
    QStringList rows;
    for (const std::size_t i : m_library.shown())
        rows << m_library.items()[i].source;
    if (rows != m_rows) {
        beginResetModel();
        m_rows = std::move(rows);
        endResetModel();
    } else if (!m_rows.isEmpty()) {
        Q_EMIT dataChanged(index(0), index(rowCount() - 1));
    }
}

int LibraryModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

const LibraryItem* LibraryModel::at(const QModelIndex& index) const {
    const auto row = static_cast<std::size_t>(index.row());
    if (!index.isValid() || row >= m_library.shown().size())
        return nullptr;
    return &m_library.items()[m_library.shown()[row]];
}

QModelIndex LibraryModel::indexOf(const QString& source) const {
    const qsizetype row = m_rows.indexOf(source);
    return row < 0 ? QModelIndex() : index(static_cast<int>(row));
}

QPixmap LibraryModel::picture(const LibraryItem& item) const {
    if (!item.measured)
        return {};
    // Measured anew, it is another.
    if (const auto* kept = m_pictures.object(item.source); kept && kept->first == item.entry.get())
        return kept->second;
    const Image& thumbnail = item.entry->thumbnail;
    const QImage image(thumbnail.u8().data(), thumbnail.width(), thumbnail.height(),
                       3 * thumbnail.width(), QImage::Format_RGB888);
    const QPixmap pixmap = QPixmap::fromImage(image);
    m_pictures.insert(item.source, new std::pair<const void*, QPixmap>(item.entry.get(), pixmap));
    return pixmap;
}

QVariant LibraryModel::data(const QModelIndex& index, int role) const {
    const LibraryItem* item = at(index);
    if (!item)
        return {};
    switch (role) {
    case Qt::DisplayRole:
        return toQString(item->entry->title);
    case Qt::ToolTipRole:
        return toolTipText(*item);
    case Qt::StatusTipRole:
        if (item->source == m_library.current())
            return tr("%1 lights the scene; drag the handle in its picture, or Shift and drag, to "
                      "rotate it")
                .arg(toQString(item->entry->title));
        return (item->source.startsWith(QLatin1String("builtin:"))
                    ? tr("Double-click or press Enter to light the scene with %1; drag it onto the "
                         "picture or a cell of the wall")
                    : tr("Double-click or press Enter to light the scene with %1; drag it to other "
                         "programs or onto the picture"))
            .arg(toQString(item->entry->title));
    case Qt::AccessibleTextRole: {
        const QString tags = tagsText(*item);
        return tags.isEmpty() ? toQString(item->entry->title)
                              : tr("%1, %2").arg(toQString(item->entry->title), tags);
    }
    case Qt::AccessibleDescriptionRole:
        return describedText(*item);
    case SourceRole:
        return item->source;
    case SubtitleRole:
        return sortedText(*item, m_library.query().sort);
    case FavouriteRole:
        return m_library.isFavourite(item->source);
    case CurrentRole:
        return item->source == m_library.current();
    case RotationRole:
        return item->source == m_library.current() ? QVariant(m_library.rotationDeg()) : QVariant();
    case DuplicateRole:
        return !item->duplicateOf.isEmpty();
    case PictureRole:
        return picture(*item);
    default:
        return {};
    }
}

Qt::ItemFlags LibraryModel::flags(const QModelIndex& index) const {
    const LibraryItem* item = at(index);
    if (!item)
        return Qt::NoItemFlags;
    return Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsDragEnabled |
           Qt::ItemNeverHasChildren;
}

QStringList LibraryModel::mimeTypes() const {
    return {QStringLiteral("text/uri-list"), QLatin1String(kEnvironmentMime)};
}

QMimeData* LibraryModel::mimeData(const QModelIndexList& indexes) const {
    QStringList sources;
    for (const QModelIndex& each : indexes)
        if (const LibraryItem* item = at(each))
            sources << item->source;
    auto* data = new QMimeData;
    setDraggedSources(*data, sources);
    return data;
}

} // namespace patina::editor
