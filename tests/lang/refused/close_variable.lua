function height(p)
  local x <close> = 1
  return p.x
end
-- error: 2:9 close-variable
