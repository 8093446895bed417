// Two cells of the wall against each other in the place of the enlarged one: A is the current cell,
// B another. How both are shown (a split line, turns, a blend, their difference), and how far they
// are apart, measured in the background of the pictures as displayed.
#pragma once

#include "app/editor/viewport/SplitHandle.h"
#include "core/compare/ErrorMap.h"
#include "core/compare/Metrics.h"
#include "core/image/ColorMap.h"
#include "core/job/TaskRunner.h"

#include <QImage>
#include <QTimer>
#include <memory>

namespace patina::editor {

class WallState;

enum class CompareMode { Wipe, Flicker, Blend, Signed, Absolute, Relative, Visible };

// What is seen below this is hidden where only visible differences are shown: FLIP.
inline constexpr float kVisibleFlip = 0.05f;

class WallComparison : public SplitModel {
    Q_OBJECT
  public:
    WallComparison(WallState& wall, TaskRunner& runner, QObject* parent = nullptr);

    [[nodiscard]] bool isOn() const; // there is a B: WallState::compared()
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
    [[nodiscard]] bool isOutdated() const { return isOn() && m_outdated; }
    [[nodiscard]] bool isMeasuring() const { return m_tasks.busy(); }
    void measure(Image a, Image b); // both as displayed; the newest wins

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
    TaskGroup m_tasks; // last: it ends first
};

} // namespace patina::editor
