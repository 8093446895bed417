// The Energy dock: the material in a furnace, in numbers and curves. What it loses between facets
// and what compensation gives back, where it makes light, and a furnace for the viewport to look at
// it.
#pragma once

#include "app/editor/panel/EnergyTexts.h"
#include "core/light/EnergyStudy.h"

#include <QWidget>
#include <optional>

class QComboBox;
class QLabel;
class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class DocumentController;
class EnergyBars;
class EnergyMap;
class EnergyPlot;
class LatestJob;
class NumberField;
class PlotLegend;
class SelectionModel;
class ViewState;

class EnergyPanel : public QWidget {
    Q_OBJECT
  public:
    EnergyPanel(DocumentController& controller, SelectionModel& selection, ViewState& views,
                QWidget* parent = nullptr);
    ~EnergyPanel() override;

    // What is shown; nothing before the first, or without a material.
    [[nodiscard]] const std::optional<EnergyStudy>& study() const { return m_study; }
    [[nodiscard]] double angleDeg() const { return m_angleDeg; }
    void setAngle(double angleDeg); // of the curve over roughness, 0…90

  Q_SIGNALS:
    void studied(); // study() is new

  protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override; // plots stay in view beside a long ledger

  private:
    struct MapRanges; // of maps seen lately
    [[nodiscard]] QWidget* makeChoices();
    [[nodiscard]] QWidget* makeLedger();
    [[nodiscard]] EnergyChannel channel() const;
    [[nodiscard]] const Material* material() const;
    void request(); // a new study, if anybody looks
    void refresh();
    void refreshLedger();
    void refreshFaults();
    void refreshPlots();
    void setCompensation(bool on);
    void fix(EnergyFix fix);

    DocumentController& m_controller;
    SelectionModel& m_selection;
    LatestJob* m_job;
    std::shared_ptr<MapRanges> m_ranges; // only the job's thread uses it
    std::optional<EnergyStudy> m_study;
    double m_angleDeg = 45.0;

    QComboBox* m_channel;
    NumberField* m_angle;
    QLabel *m_loss, *m_return;
    QPushButton* m_compensate;
    EnergyBars* m_bars;
    QVBoxLayout* m_faults;
    EnergyPlot *m_byRoughness, *m_byAngle;
    EnergyMap* m_map;
    PlotLegend* m_legend;
};

} // namespace patina::editor
