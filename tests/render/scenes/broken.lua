function color(p)
  return p.x .. "no"
end
