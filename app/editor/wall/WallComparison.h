// Two pictures against each other in the place of the enlarged cell: A is that cell, B another one
// or a picture from a file. How both are shown (a split line, turns, a blend, their difference),
// and how far they are apart, measured in the background of the pictures as displayed.
#pragma once

#include "app/editor/viewport/SplitHandle.h"
#include "core/cells/ReferencePicture.h"
#include "core/compare/ErrorMap.h"
#include "core/compare/Metrics.h"
#include "core/image/ColorMap.h"
#include "core/job/TaskRunner.h"

#include <QImage>
#include <QTimer>
#include <memory>

namespace patina {
class WorkerClient;
}

namespace patina::editor {

class WallState;

enum class CompareMode { Wipe, Flicker, Blend, Signed, Absolute, Relative, Visible };

// What is seen below this is hidden where only visible differences are shown: FLIP.
inline constexpr float kVisibleFlip = 0.05f;

class WallComparison : public SplitModel {
    Q_OBJECT
  public:
    // `worker` reads files.
    WallComparison(WallState& wall, TaskRunner& runner, WorkerClient& worker,
                   QObject* parent = nullptr);

    [[nodiscard]] bool isOn() const; // there is a B: WallState::compared(), or a file
    // B is this picture, which is read in the background; empty: none. A cell that is chosen takes
    // its place.
    void setFile(const QString& path);
    [[nodiscard]] bool hasFile() const { return !m_filePath.isEmpty(); }
    [[nodiscard]] QString fileName() const;
    // Why it is not shown, or what was done to it: "1920 × 1080 fitted to 640 × 360".
    [[nodiscard]] const QString& fileNote() const { return m_fileNote; }
    [[nodiscard]] bool needsStretch() const; // its proportions are not the cell's
    [[nodiscard]] const ReferenceSettings& fileSettings() const { return m_fileSettings; }
    void setFileSettings(const ReferenceSettings& settings);
    [[nodiscard]] bool wantsRadiance() const; // measureFile() needs A before its tone curve
    // As it is shown; null: not ready.
    [[nodiscard]] const QImage& filePicture() const { return m_filePicture; }
    [[nodiscard]] CompareMode mode() const { return m_mode; }
    void setMode(CompareMode mode);
    [[nodiscard]] bool showsDifference() const { return isOn() && m_mode >= CompareMode::Signed; }
    [[nodiscard]] float blend() const { return m_blend; } // 0 A … 1 B
    void setBlend(float blend);
    [[nodiscard]] double flickerHz() const { return m_flickerHz; } // pictures per second
    void setFlickerHz(double hz);
    [[nodiscard]] bool onlyVisible() const { return m_onlyVisible; }
    void setOnlyVisible(bool only);
    void setPeeking(bool peeking); // B alone, as long as a key is held

    // What of B is shown over A.
    struct Shown {
        bool any = false;
        std::optional<render::ViewSplit> split; // on its right alone
        float opacity = 1.0f;
    };
    [[nodiscard]] Shown shown() const;

    // --- Measured
    // ---------------------------------------------------------------------------------
    struct Measured {
        ImageMetrics metrics; // A against B
        ErrorSummary flip;
        QImage map; // of a difference; null in other modes
        ColorMap colors = ColorMap::Grey;
        float from = 0.0f, to = 1.0f; // that the ends of the colours stand for
    };
    [[nodiscard]] const std::optional<Measured>& measured() const { return m_measured; }
    [[nodiscard]] const QString& problem() const { return m_problem; } // why nothing is measured
    void outdate();                                                    // pictures will be others
    void refine() { m_outdated = true; } // pictures of the same are finer: measured once more
    [[nodiscard]] bool isOutdated() const { return isOn() && m_outdated; }
    [[nodiscard]] bool isMeasuring() const { return m_tasks.busy(); }
    void measure(Image a, Image b); // both as displayed; the newest wins
    // The file against A as displayed and, if wantsRadiance(), before exposure and tone curve;
    // `view`: of A.
    void measureFile(Image displayed, Image radiance, const View& view);

    // --- The line of a wipe
    // -----------------------------------------------------------------------
    [[nodiscard]] std::optional<render::ViewSplit> line() const override;
    void moveLine(const render::ViewSplit& line) override;
    void removeLine() override;
    [[nodiscard]] QString leftName() const override;
    [[nodiscard]] QString rightName() const override;
    [[nodiscard]] QRect area(const QSize& viewport) const override;

  Q_SIGNALS:
    void changed();         // what is shown, and how
    void measuredChanged(); // measured(), problem()

  private:
    void follow();
    void runFlicker();
    void measureAgain();
    void forgetFile();
    [[nodiscard]] QString nameOf(std::optional<std::size_t> cell) const;

    WallState& m_wall;
    CompareMode m_mode = CompareMode::Wipe;
    render::ViewSplit m_line;
    float m_blend = 0.5f;
    double m_flickerHz = 2.0;
    bool m_onlyVisible = false, m_peeking = false, m_turn = false, m_outdated = true;
    QTimer m_flicker;
    std::shared_ptr<const Image> m_a, m_b; // measured last
    std::optional<Measured> m_measured;
    QString m_problem;
    WorkerClient& m_worker;
    QString m_filePath, m_fileNote;
    ImagePtr m_file; // as it was read; null: it is being read, or could not be
    ReferenceSettings m_fileSettings;
    QImage m_filePicture;
    QSize m_fileCell;             // of A, when it was measured last
    TaskGroup m_tasks, m_reading; // last: they end first
};

} // namespace patina::editor
