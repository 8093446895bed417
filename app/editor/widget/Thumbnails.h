// Small pictures of images, made in the background and kept while there is room.
#pragma once

#include "core/image/Image.h"
#include "core/job/TaskRunner.h"
#include "core/material/MapSlot.h"

#include <QHash>
#include <QImage>
#include <QObject>
#include <memory>

namespace patina::editor {

// An image as a screen shows it: Data as it is, high dynamic range exposed and tone mapped. Of a
// single channel in grey; Rgb ignores alpha.
[[nodiscard]] QImage displayImage(const Image& image, int maxSide, float exposureEv = 0.0f,
                                  MapChannel channel = MapChannel::Rgb);

class Thumbnails : public QObject {
    Q_OBJECT
  public:
    explicit Thumbnails(TaskRunner& runner, QObject* parent = nullptr);

    // At most `side` pixels; null until ready() comes.
    [[nodiscard]] QImage thumbnail(const ImagePtr& image, int side,
                                   MapChannel channel = MapChannel::Rgb);

  Q_SIGNALS:
    void ready();

  private:
    struct Entry {
        std::weak_ptr<const Image> image; // an address may be used again when the image is gone
        QImage picture;                   // null while it is being made
    };
    using Key = QPair<quintptr, QPair<int, int>>; // address of the image; side and channel
    QHash<Key, Entry> m_entries;
    TaskGroup m_tasks;
};

} // namespace patina::editor
