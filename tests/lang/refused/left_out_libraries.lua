function height(p)
  io.write("x")
  local t = os.time()
  local s = string.rep("x", 3)
  table.insert(p, 1)
  debug.traceback()
  utf8.char(65)
  return p.x
end
-- error: 2:3 library-left-out
-- error: 3:13 library-left-out
-- error: 4:13 library-left-out
-- error: 5:3 library-left-out
-- error: 6:3 library-left-out
-- error: 7:3 library-left-out
