// The photos of a bracket as rows: their exposures, which can be typed, and what was found of them.
#pragma once

#include "core/bracket/Bracket.h"

#include <QStringList>
#include <QTableWidget>
#include <vector>

namespace patina::editor {

class BracketTable : public QTableWidget {
    Q_OBJECT
  public:
    explicit BracketTable(const QStringList& photos, QWidget* parent = nullptr);

    // Of each photo what its file says, and stops where they are known (else 0 each).
    void setExposures(const std::vector<PhotoExposure>& exposures, const std::vector<double>& evs);
    void setFound(const BracketReport& report);
    void clearFound();
    // In stops, in the order of the photos; as exact as what was set where nothing was typed.
    [[nodiscard]] const std::vector<double>& exposuresEv() const { return m_evs; }

  Q_SIGNALS:
    void exposureTyped();

  private:
    enum Column { Photo, Exposure, Ev, Shift, White, Black };
    void set(int row, Column column, const QString& text, const QString& help = {});

    QStringList m_photos;
    std::vector<double> m_evs;
};

} // namespace patina::editor
