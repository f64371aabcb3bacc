#pragma once

#include <QUndoCommand>

#include <functional>
#include <utility>

namespace palp
{

/// Something that was done, and can be taken back and done again.
class Change : public QUndoCommand
{
public:
  using Act = std::function<void()>;

  /// @param what  for people, behind Undo and Redo
  /// @param undo, redo  do not throw
  Change(const QString& what, Act undo, Act redo)
    : QUndoCommand(what)
    , undo_(std::move(undo))
    , redo_(std::move(redo))
  {
  }

  void undo() override
  {
    undo_();
    isDone_ = false;
  }

  // a stack calls it once as it takes what was done already
  void redo() override
  {
    if (!std::exchange(isDone_, true))
    {
      redo_();
    }
  }

private:
  Act undo_;
  Act redo_;
  bool isDone_ = true;
};

} // namespace palp
