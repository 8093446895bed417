// A map as the user handles it: a thumbnail to click or to drop a file on, the name of its source,
// the channel that is read, tiling and removal.
#pragma once

#include "core/material/MapSlot.h"

#include <QFrame>
#include <QImage>

class QComboBox;
class QLabel;
class QToolButton;

namespace patina::editor {

class NumberField;
class Thumbnails;

class MapSlotWidget : public QFrame {
    Q_OBJECT
  public:
    // `name`: of the map, for the accessible names ("Roughness map"); `wholeColor`: all channels
    // are used, so that there is none to choose.
    MapSlotWidget(Thumbnails& thumbnails, const QString& name, bool wholeColor,
                  QWidget* parent = nullptr);
    void setSlot(const MapSlot& slot); // shows, emits nothing

    // "bricks_diffuse.png", "Worn Painted Metal", "image 2 of chair.glb".
    [[nodiscard]] static QString sourceTitle(const std::string& source);

  Q_SIGNALS:
    void browseRequested();
    void fileDropped(const QString& file);
    void clearRequested();
    void channelChosen(patina::MapChannel channel);
    // Tiling: `slot` is the shown one with another scale, offset or rotation.
    void tilingDragStarted();
    void tilingDragged(const patina::MapSlot& slot);
    void tilingDragFinished();
    void tilingEdited(const patina::MapSlot& slot);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragLeaveEvent(QDragLeaveEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    QWidget* makeTiling();
    void addTilingField(int row, int column, const QString& name, float MapSlot::*angle,
                        glm::vec2 MapSlot::*vector, int component);
    void show(const MapSlot& slot);
    void refreshThumbnail();

    Thumbnails& m_thumbnails;
    QString m_name;
    MapSlot m_slot; // as shown
    QImage m_picture;
    bool m_dropHover = false;
    QLabel* m_title;
    QLabel* m_facts;
    QComboBox* m_channel;
    QToolButton* m_browse;
    QToolButton* m_tilingButton;
    QToolButton* m_clear;
    QWidget* m_tiling;
    std::vector<std::function<void()>> m_refreshTiling;
};

} // namespace patina::editor
