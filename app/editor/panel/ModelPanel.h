// The Shading dock: which terms make up the reflection, with presets and a white-furnace plot.
#pragma once

#include "core/document/Document.h"

#include <QWidget>
#include <vector>

class QPushButton;

namespace patina::editor {

class DocumentController;
class FurnacePlot;
class ParameterList;
class SelectionModel;
class Thumbnails;

class ModelPanel : public QWidget {
    Q_OBJECT
  public:
    ModelPanel(DocumentController& controller, SelectionModel& selection, Thumbnails& thumbnails,
               QWidget* parent = nullptr);

  private:
    QWidget* makePresets();
    QWidget* makeMetals();
    void refresh();
    void apply(const ShadingModel& model, const QString& undoText);

    DocumentController& m_controller;
    SelectionModel& m_selection;
    std::vector<QPushButton*> m_presets, m_metals; // in the order of their tables
    QWidget* m_metalBox;
    FurnacePlot* m_furnace;
    ParameterList* m_parameters;
};

} // namespace patina::editor
