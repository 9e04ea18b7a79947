function height(p)
  local unused = p.y
  return p.x
end
