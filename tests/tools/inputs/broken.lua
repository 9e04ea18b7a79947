function height(p)
  if p.x then return 1 end
  return undefined_name
end
