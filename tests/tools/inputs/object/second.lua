function height(fw)
  return fw + 42
end
