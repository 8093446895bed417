// Saves the wall as a sheet: draws its cells in their own size between events, one frame at a time,
// and hands them to a job that puts the sheet together and writes it. Deletes itself at the end.
#pragma once

#include "app/editor/viewport/FrameSchedule.h"
#include "app/editor/wall/WallPainter.h"
#include "core/cells/Wall.h"
#include "core/sheet/SheetPictures.h"

#include <QObject>
#include <QString>
#include <memory>
#include <vector>

namespace patina::editor {

class DocumentController;
class JobManager;
class ViewportWidget;
class WallState;

enum class SheetFormat { Png, Jpeg, Tiff, Exr, Pdf };

struct SheetOrder {
    QString file;
    SheetFormat format = SheetFormat::Png;
    int cellWidth = 640; // pixels; the height is as on screen
    bool captions = true;
    QString title;
};

class SheetSave : public QObject {
    Q_OBJECT
  public:
    SheetSave(SheetOrder order, const WallState& wall, ViewportWidget& viewport,
              DocumentController& controller, JobManager& jobs);
    ~SheetSave() override;

    // Pictures on their way from here to the job.
    struct Hand;

  private:
    void draw(); // one frame
    void fail(const Error& error);
    void wallWasChanged();
    bool endsWithJob();

    SheetOrder m_order;
    ViewportWidget& m_viewport;
    DocumentController& m_controller;
    Wall m_wall; // as it was when it was asked for
    std::vector<WallCell> m_cells;
    std::vector<WallPainter::SheetCell> m_views; // empty: the wall is not ready yet
    std::size_t m_next = 0;                      // cell
    bool m_begins = true;                        // its first frame is next
    std::shared_ptr<Hand> m_hand;
    FrameSchedule::Task m_frame; // the next one, of the viewport's turns
};

} // namespace patina::editor
