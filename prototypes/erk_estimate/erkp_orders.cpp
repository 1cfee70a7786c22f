#include <array>
#include <vector>
#include <functional>
#include <cstdio>
#include <Eigen/Dense>
#define DALEMBERT_HIDDEN
#include "erkp_verner.h"
using dalembert::verner87;
struct Tree { std::vector<Tree> children; int order = 1; };
void forests(const std::vector<Tree>& pool, size_t first, int order, std::vector<Tree>& chosen, const std::function<void(const std::vector<Tree>&)>& visit) {
  if (order == 0) return visit(chosen);
  for (size_t i = first; i < pool.size(); ++i) { if (pool[i].order > order) continue; chosen.push_back(pool[i]); forests(pool, i, order - pool[i].order, chosen, visit); chosen.pop_back(); }
}
std::vector<Tree> trees_up_to(int order) {
  std::vector<Tree> all{Tree{}};
  for (int k = 2; k <= order; ++k) { const auto smaller = all; std::vector<Tree> chosen;
    forests(smaller, 0, k - 1, chosen, [&](const std::vector<Tree>& c) { all.push_back({c, k}); }); }
  return all;
}
double density(const Tree& t) { double p = t.order; for (auto& c : t.children) p *= density(c); return p; }
double A[14][14];
std::array<double,14> sw(const Tree& t) { std::array<double,14> phi; phi.fill(1); for (auto& c : t.children) { auto b = sw(c); for (int i=0;i<14;++i){double s=0; for(int j=0;j<14;++j) s+=A[i][j]*b[j]; phi[i]*=s;} } return phi; }
int main(){
  for(int i=0;i<13;++i)for(int j=0;j<13;++j)A[i][j]=verner87.a[i][j];
  for(int j=0;j<13;++j)A[13][j]=verner87.b[j];
  for(int p=1;p<=9;++p){
    auto ts=trees_up_to(p);
    // stage orders: max defect of A-row against tall quadrature: sum a_ij phi_j(t) vs c^|t|.../density
    for (int all : {0,1,2}) {
      std::vector<int> st; for(int i=0;i<14;++i){ if(all==0 && ((i>=1&&i<=4)||i==13)) continue; if(all==1&&(i>=1&&i<=4)) continue; st.push_back(i);} 
      Eigen::MatrixXd M(ts.size(),st.size());
      for(size_t r=0;r<ts.size();++r){auto phi=sw(ts[r]); for(size_t c=0;c<st.size();++c) M(r,c)=phi[st[c]];}
      Eigen::JacobiSVD<Eigen::MatrixXd> svd(M,Eigen::ComputeFullV);
      int rank=0; for(int i=0;i<svd.singularValues().size();++i) if(svd.singularValues()[i]>1e-12*svd.singularValues()[0]) ++rank;
      printf("p=%d set=%d stages=%zu null dim=%zu  sv:",p,all,st.size(),st.size()-rank);
      for(int i=std::max(0,rank-2);i<svd.singularValues().size();++i)printf(" %.1e",svd.singularValues()[i]); printf("\n");
    }
  }
  // stage order: y_i vs exact
  for(int i=1;i<14;++i){ double c=i<13?verner87.c[i]:1; for(int p=1;p<=9;++p){ double worst=0; for(auto&t:trees_up_to(p)) if(t.order==p){auto phi=sw(t); double s=0; for(int j=0;j<14;++j)s+=A[i][j]*phi[j]; worst=std::max(worst,std::abs(s-std::pow(c,p)/density(t)));} printf(" %.1e",worst);} printf("  stage %d c=%.4f\n",i+1,c);}
}
