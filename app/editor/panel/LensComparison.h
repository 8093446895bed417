// What stands beside the scene's own look under the lens: presets of the shading model, the model
// without compensation, or the material as it was. Its button and legend, each look with the colour
// it keeps.
#pragma once

#include "core/light/LensCurves.h"

#include <QObject>
#include <QString>
#include <functional>
#include <optional>
#include <vector>

class QHBoxLayout;
class QMenu;
class QToolButton;
class QWidget;

namespace patina::editor {

class LensComparison : public QObject {
    Q_OBJECT
  public:
    struct Look {
        int slot = 0; // colour and dash: PlotStyle.h
        QString name;
        ShadingModel model;
        std::optional<SurfacePoint> point; // its own; otherwise the scene's
    };

    // `shown`: what the lens shows of the scene now, to be frozen; nothing when it shows nothing.
    explicit LensComparison(std::function<std::optional<LensLook>()> shown,
                            QObject* parent = nullptr);

    [[nodiscard]] QToolButton* button() const { return m_button; } // both for a layout to own
    [[nodiscard]] QWidget* legend() const { return m_legend; }

    // The scene's own first.
    [[nodiscard]] std::vector<Look> looks(const ShadingModel& model) const;

  Q_SIGNALS:
    void changed();

  private:
    enum class Kind { Preset, SingleScatter, Frozen };
    struct Entry {
        Kind kind = Kind::Preset;
        int preset = 0; // of modelPresets()
        int slot = 1;
        LensLook frozen;
    };
    [[nodiscard]] std::vector<Entry>::iterator find(const Entry& entry);
    void toggle(const Entry& entry, bool compare);
    void clear();
    void fillMenu();
    void fillLegend();
    [[nodiscard]] static QString nameOf(const Entry& entry);
    [[nodiscard]] static ShadingModel modelOf(const Entry& entry, const ShadingModel& model);

    std::function<std::optional<LensLook>()> m_shown;
    std::vector<Entry> m_entries;
    QToolButton* m_button;
    QMenu* m_menu;
    QWidget* m_legend;
    QHBoxLayout* m_row;
};

} // namespace patina::editor
