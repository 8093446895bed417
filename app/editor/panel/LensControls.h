// The controls of the BRDF lens: which plots, where the light stands, and what of the reflection
// they show.
#pragma once

#include "core/light/LobeMesh.h"

#include <QWidget>
#include <vector>

class QComboBox;
class QToolButton;

namespace patina::editor {

class FlowLayout;
class NumberField;
class Slider;

class LensControls : public QWidget {
    Q_OBJECT
  public:
    enum class Page { Lobe, Factors, Albedo, All };

    explicit LensControls(QWidget* parent = nullptr);

    void add(QWidget* widget); // after the others

    void setPage(Page page);
    [[nodiscard]] Page page() const { return m_page; }
    void setIncidence(double degrees); // of the light, 0…89
    [[nodiscard]] double incidence() const { return m_incidence; }
    [[nodiscard]] LobeScale scale() const;

  Q_SIGNALS:
    void pageChanged();
    void changed(); // incidence or scale

  private:
    QWidget* makePages();
    QWidget* makeIncidence();
    QComboBox* makeChoice(const QString& name, const QString& help, const QStringList& items);

    FlowLayout* m_flow;
    Page m_page = Page::Lobe;
    double m_incidence = 45.0;
    std::vector<QToolButton*> m_pages;
    Slider* m_slider = nullptr;
    NumberField* m_angle = nullptr;
    QComboBox *m_quantity, *m_lobe, *m_channel;
    QToolButton* m_logarithmic;
};

} // namespace patina::editor
