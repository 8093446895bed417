// The picture as its sum, under the viewport: image-based and direct light, diffuse and specular,
// and emission are live thumbnails that are switched, shown alone, looked at, and opened into their
// factors. It folds away to one line, the sum; what the picture lacks is said in either.
#pragma once

#include "app/editor/viewport/SheetScheduler.h"
#include "core/document/Equation.h"

#include <QPointer>
#include <QWidget>
#include <array>
#include <map>
#include <vector>

class QBoxLayout;
class QComboBox;
class QLabel;
class QScrollArea;
class QToolButton;

namespace patina::editor {

class DocumentController;
class FoldButton;
class TermTile;
class TracedSide;
class ViewState;

class EquationBar : public QWidget, private SheetClient {
    Q_OBJECT
  public:
    // `traced`: a picture that is traced as a whole has an equation of its own.
    EquationBar(ViewState& views, const TracedSide& traced, DocumentController& controller,
                SheetScheduler& sheets, QWidget* parent = nullptr);
    ~EquationBar() override;

    [[nodiscard]] bool isFolded() const;
    void setFolded(bool folded); // remembered over sessions

    // Which view is open: the picture as its sum, or one of its terms or factors.
    [[nodiscard]] ViewKind opened() const { return m_path.back(); }
    void open(ViewKind kind);      // a part of what is open
    void close(std::size_t depth); // back to a part that was opened before; 0: the sum
    bool back();                   // one step; false: the sum is open already

  Q_SIGNALS:
    void foldedChanged(bool folded);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] render::ViewSheet wantedSheet() const override;
    void showThumbnail(ViewKind kind, const QImage& picture) override;

    [[nodiscard]] Equation equation() const;
    [[nodiscard]] LightingMode lighting() const; // of the picture
    void refresh();
    void refreshHeader();
    void refreshCrumbs();
    void refreshLights();
    bool chooseLight(); // whether it has changed the chosen light
    void buildRow(const Equation& equation);
    void addPart(QBoxLayout& row, const EquationPart& part);
    TermTile* addTile(QBoxLayout& row, TermTile* tile);
    void solo(std::size_t term);

    ViewState& m_views;
    const TracedSide& m_traced;
    DocumentController& m_controller;
    QPointer<SheetScheduler> m_sheets; // the viewport's, which may go first
    FoldButton* m_fold;
    QToolButton* m_allOn;
    QWidget* m_crumbs;
    QLabel *m_lacks, *m_formula, *m_note;
    QComboBox* m_lights;
    QScrollArea* m_scroll;
    std::vector<ViewKind> m_path{shading::kViewFinal}; // from the sum to what is open
    std::vector<ViewKind> m_crumbsShown;
    std::vector<TermTile*> m_tiles;        // of the row: its parts, then what they come to
    const EquationPart* m_built = nullptr; // the row's parts
    LightingMode m_builtFor{};             // which names them
    // The newest pictures, for tiles that are made later: the scheduler draws each once.
    std::map<ViewKind, QImage> m_pictures;
    std::array<bool, kTermCount> m_beforeSolo{true, true, true, true, true};
};

} // namespace patina::editor
